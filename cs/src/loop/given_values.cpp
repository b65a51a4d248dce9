// SPDX-License-Identifier: Apache-2.0
#include "loop/given_values.hpp"

#include "cortex/core/simplex.hpp"
#include "cortex/core/system_findings.hpp"
#include "cortex/core/tables.hpp"

#include <algorithm>
#include <string>

namespace cortex::cs {
namespace {

// The value as the cells of the item take it: one serves a whole array.
Value wholeValue(const InitialValue& given) {
    Value value = given.value;
    std::visit(
        [&](auto& elements) {
            if (elements.empty()) return;
            const auto last = elements.back();
            elements.resize(given.item->item->length, last);
        },
        value);
    return value;
}

Place placeOf(const Simplex& simplex, const std::string& item) {
    const auto found = std::ranges::find(simplex.settings(), item, &Simplex::Setting::item);
    return found != simplex.settings().end() ? found->place : Place{};
}

}  // namespace

GivenValues::GivenValues(AgentRuntime& agent) : agent_{agent} {
    for (const InitialValue& each : agent.structure().initial) {
        if (!each.item->constant) given_[each.simplex].push_back(&each);
    }
}

void GivenValues::check(std::uint32_t simplex, Report& report) const {
    if (given_.empty()) return;
    const Structure& structure = agent_.structure();
    compare(simplex, simplex, agent_.tables().live(simplex), report);
    const SimplexInfo& info = structure.simplexes[simplex];
    for (std::uint32_t i = info.firstEdge; i < info.firstEdge + info.edgeCount; ++i) {
        const Edge& edge = structure.edges[i];
        const SimplexInfo& target = structure.simplexes[edge.target];
        const bool writes = edge.rule->direction == Direction::Output;
        if (!writes || target.remote || target.role == Role::Active) continue;
        compare(simplex, edge.target, agent_.tables().edge(i), report);
    }
}

void GivenValues::checkDemands(Report& report) const {
    const Structure& structure = agent_.structure();
    for (const auto& [simplex, values] : given_) {
        const SimplexInfo& info = structure.simplexes[simplex];
        if (info.role != Role::Modification) continue;
        const auto edge = std::ranges::find_if(structure.edges, [&](const Edge& each) {
            return each.target == simplex && each.rule->direction == Direction::Output;
        });
        if (edge == structure.edges.end()) continue;
        const Slice out =
            agent_.tables().edge(static_cast<std::uint32_t>(edge - structure.edges.begin()));
        for (const InitialValue* each : values) {
            const DataItem& item = *each->item->item;
            if (item.safe.kind == Safe::Kind::None) continue;
            const Value value = loadValue(item, out.at(item.kind, each->item->offset));
            const Value given = wholeValue(*each);
            if (value == given) continue;
            report.error(info.path, finding::startValueInVain,
                         placeOf(agent_.simplex(simplex), item.name),
                         item.name + " is given as " + toText(given) + ", and begins at " +
                             toText(value) + ", where the demand is safe",
                         item.safe.kind == Safe::Kind::Given
                             ? "leave it out"
                             : "leave it out, or give it to the simplex that observes the demand");
        }
    }
}

void GivenValues::compare(std::uint32_t writer, std::uint32_t simplex, const Slice& written,
                          Report& report) const {
    const auto found = given_.find(simplex);
    if (found == given_.end()) return;
    const Structure& structure = agent_.structure();
    for (const InitialValue* each : found->second) {
        const DataItem& item = *each->item->item;
        const Value value = loadValue(item, written.at(item.kind, each->item->offset));
        const Value given = wholeValue(*each);
        if (value == given) continue;
        std::string what = item.name;
        if (simplex != writer) what += " of " + structure.simplexes[simplex].path;
        report.error(structure.simplexes[writer].path, finding::startValueOverwritten,
                     placeOf(agent_.simplex(simplex), item.name),
                     "populate() writes " + toText(value) + " over " + what +
                         ", which is given as " + toText(given),
                     "read it, or write only where hasValue(\"" + item.name + "\") is false");
    }
}

}  // namespace cortex::cs
