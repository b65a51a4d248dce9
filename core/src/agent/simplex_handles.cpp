// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/simplex.hpp"

#include "model/resolved_relations.hpp"
#include "tables/lookup.hpp"
#include "types/unit.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace cortex {

namespace {

std::string placeOf(const DataItem& item) {
    const std::string place = item.place.text();
    return place.empty() ? "" : " [" + place + "]";
}

void checkUnit(const DataItem& item, std::string_view assumed, const std::string& where) {
    if (assumed.empty()) return;
    std::string why;
    const std::optional<Unit> unit = parseUnit(assumed, why);
    if (!unit)
        throw Error(where + ": the code assumes the unit '" + std::string{assumed} + "': " + why);
    if (unit->canonical == item.unit) return;
    if (item.unit == openUnit) {
        throw Error(where + ": its type leaves the unit open, the code assumes " + unit->canonical +
                    ": name the type that the other agent has there, <relate … type=\"…\"/>");
    }
    throw Error(where + " is in " + (item.unit.empty() ? "no stated unit" : item.unit) +
                ", the code assumes " + unit->canonical +
                ": convert in the code, or state that unit in the type" + placeOf(item));
}

void checkShape(const DataItem& item, const ItemAccess& access, const std::string& where) {
    const std::string asked = std::string{access.write ? "writing" : "reading"} + " one " +
                              (access.array ? "array of " : "") + name(access.kind);
    if (item.kind != access.kind || (item.length > 1 && !access.array)) {
        throw Error(where + " is " + shapeOf(item) + ": " + asked +
                    " does not fit; take data<…>() or array<…>() of its kind");
    }
    if (access.write && item.constant) {
        throw Error(where + " is constant: take a handle to const");
    }
    checkUnit(item, access.unit, where);
}

// What every active simplex, agent and cluster shows of itself. Of a long command the progress is
// the simplex's own.
bool isOfFramework(const Structure& structure, const SimplexInfo& info, std::string_view item) {
    if (info.role != Role::Active || item == "progress") return false;
    const Type& type = *info.layout->type;
    return std::ranges::any_of(
        std::array{"Active", "Activity", "Agent", "Cluster"}, [&](std::string_view each) {
            const Type* base = structure.types->find(each);
            return base != nullptr && type.isA(each) && base->findData(item) != nullptr;
        });
}

const Type& typeOf(const Structure& structure, std::uint32_t simplex) {
    return *structure.simplexes[simplex].layout->type;
}

const Rule& ruleAt(const Type& type, const std::string& path, std::string_view rule) {
    const Rule* found = type.findRule(rule);
    if (found == nullptr) {
        std::vector<std::string> names;
        for (const Rule& each : type.rules) names.push_back(each.name);
        throwUnknown(path + ": type " + type.name + " has no rule '" + std::string{rule} + "'",
                     rule, names);
    }
    return *found;
}

const Rule& ruleAt(const Type& type, const std::string& path, std::string_view rule,
                   Direction direction) {
    const Rule& found = ruleAt(type, path, rule);
    if (found.direction != direction) {
        const std::string is = name(found.direction);
        throw Error(path + ": rule '" + found.name + "' is an " + is + "; ask " + is + "() or " +
                    is + "s()");
    }
    return found;
}

// The relationships of a simplex that count for a rule, in order.
std::vector<std::uint32_t> edgesOf(const Structure& structure, std::uint32_t simplex,
                                   std::string_view rule) {
    const SimplexInfo& info = structure.simplexes[simplex];
    std::vector<std::uint32_t> found;
    for (std::uint32_t edge = info.firstEdge; edge < info.firstEdge + info.edgeCount; ++edge) {
        if (countsFor(*info.layout->type, structure.edges[edge].rule->name, rule))
            found.push_back(edge);
    }
    return found;
}

[[noreturn]] void throwNoCommand(const Simplex& simplex, std::string_view command) {
    const Type& type = simplex.type();
    std::vector<std::string> names;
    for (const Command& each : type.commands) names.push_back(each.name);
    throwUnknown(
        simplex.path() + ": type " + type.name + " has no command '" + std::string{command} + "'",
        command, names);
}

std::string countOf(const Simplex& owner, std::string_view rule, std::size_t count) {
    return owner.path() + ": rule '" + std::string{rule} + "' relates " + std::to_string(count) +
           (count == 1 ? " simplex" : " simplexes");
}

}  // namespace

void throwNoSuch(const Simplex& owner, std::string_view rule, std::size_t count,
                 std::size_t place) {
    throw Error(countOf(owner, rule, count) + ", so there is no [" + std::to_string(place) + "]: " +
                (count == 0 ? "relate one" : "[0] is the first") + ", or ask size() before");
}

void throwNotOne(const Simplex& owner, std::string_view rule, std::size_t count,
                 std::string_view all) {
    throw Error(countOf(owner, rule, count) + ", not one; ask " + std::string{all});
}

const std::string& RelatedSimplex::path() const {
    const Structure& structure = owner_->runtime().structure();
    return structure.simplexes[structure.edges[edge_].target].path;
}

const Type& RelatedSimplex::type() const {
    const Structure& structure = owner_->runtime().structure();
    return typeOf(structure, structure.edges[edge_].target);
}

const SlotState& RelatedSimplex::state() const {
    return *owner_->runtime().tables().edge(edge_).state;
}

const Simplex& RelatedSimplex::simplex() const {
    AgentRuntime& runtime = owner_->runtime();
    const std::uint32_t target = runtime.structure().edges[edge_].target;
    if (runtime.structure().simplexes[target].remote) {
        throw Error(owner_->path() + ": " + path() +
                    " belongs to another agent; send it a command");
    }
    return runtime.simplex(target);
}

bool RelatedSimplex::isDelayed() const {
    return owner_->runtime().structure().edges[edge_].delayed;
}

bool RelatedSimplex::isRemote() const {
    const Structure& structure = owner_->runtime().structure();
    return structure.simplexes[structure.edges[edge_].target].remote;
}

std::vector<RelatedSimplex::Joined> RelatedSimplex::related(std::string_view rule) const {
    const Structure& structure = owner_->runtime().structure();
    const std::uint32_t target = structure.edges[edge_].target;
    ruleAt(type(), path(), rule);
    std::vector<Joined> joined;
    if (structure.simplexes[target].remote) return joined;
    for (const std::uint32_t edge : edgesOf(structure, target, rule)) {
        const SimplexInfo& other = structure.simplexes[structure.edges[edge].target];
        joined.push_back({other.path, other.layout->type});
    }
    return joined;
}

bool RelatedSimplex::has(std::string_view item) const { return type().findData(item) != nullptr; }

void* RelatedSimplex::cell(std::string_view item, const ItemAccess& access,
                           std::size_t& length) const {
    Tables& tables = owner_->runtime().tables();
    const std::uint32_t target = tables.structure().edges[edge_].target;
    const SimplexInfo& info = tables.structure().simplexes[target];
    const ItemLayout& layout = itemAt(info, item);
    const std::string where = owner_->path() + ": " + info.path + "." + layout.item->name;
    if (owner_->runtime().started()) {
        throw Error(where + ": its handle is got in populate(), not later: keep it in a member");
    }
    checkShape(*layout.item, access, where);
    if (access.write && info.role == Role::Active) {
        throw Error(where +
                    " is written by its own task only: take a handle to const, or send a "
                    "command");
    }
    const bool isDemand = info.role == Role::Modification && !info.writers.empty();
    if (access.accepted && !isDemand) {
        throw Error(where +
                    ": only a demand is accepted, this is none: read what goes out by "
                    "data<const ...>()");
    }
    length = layout.item->length;
    if (layout.constant) return tables.constants(target).at(access.kind, layout.offset);
    const Slice slice = access.accepted ? tables.accepted(target) : tables.edge(edge_);
    return slice.at(access.kind, layout.offset);
}

const Value& RelatedSimplex::safe(std::string_view item, const ItemAccess& access) const {
    const Structure& structure = owner_->runtime().structure();
    const SimplexInfo& info = structure.simplexes[structure.edges[edge_].target];
    const DataItem& found = *itemAt(info, item).item;
    const std::string where = owner_->path() + ": " + info.path + "." + found.name;
    checkShape(found, access, where);
    if (found.safe.kind == Safe::Kind::Given) return found.safe.value;
    throw Error(where + " has no safe value that its type gives as a number" + placeOf(found) +
                ": write safe=\"…\" there, or a value of your own in the device");
}

CommandSender RelatedSimplex::sender(std::string_view command, std::uint32_t capacity) const {
    return owner_->runtime().makeSender(edge_, command, capacity);
}

const bool& RelatedSimplex::isTaken() const {
    AgentRuntime& runtime = owner_->runtime();
    return runtime.tables().taken(runtime.structure().edges[edge_].target);
}

bool OutputSimplex::hasValue(std::string_view item) const {
    return !isRemote() && simplex().hasValue(item);
}

AgentRuntime& Simplex::startedRuntime() const {
    if (runtime_ != nullptr) return *runtime_;
    throw Error(path() + ": data and relationships exist from populate() on");
}

void* Simplex::cell(std::string_view item, const ItemAccess& access, std::size_t& length) {
    const Tables& tables = startedRuntime().tables();
    const SimplexInfo& info = tables.structure().simplexes[index_];
    const ItemLayout& layout = itemAt(info, item);
    const std::string where = path() + "." + layout.item->name;
    checkShape(*layout.item, access, where);
    if (access.write && !info.writers.empty()) {
        throw Error(where + " is written by " +
                    tables.structure().simplexes[info.writers.front()].path);
    }
    if (access.write && runtime_->writersRefused()) {
        throw Error(where +
                    ": the loop runs; a program sends the command `set`, a simplex gets its "
                    "handles in populate()");
    }
    if (access.write && isOfFramework(tables.structure(), info, layout.item->name)) {
        throw Error(where + " is written by the framework: take a handle to const");
    }
    length = layout.item->length;
    const Slice slice = layout.constant ? tables.constants(index_) : tables.live(index_);
    return slice.at(access.kind, layout.offset);
}

bool Simplex::hasValue(std::string_view item) const {
    const Structure& structure = startedRuntime().structure();
    const DataItem& known = *itemAt(structure.simplexes[index_], item).item;
    return std::ranges::find(settings(), known.name, &Setting::item) != settings().end();
}

SlotState& Simplex::slot() { return *startedRuntime().tables().live(index_).state; }

InputSimplex Simplex::input(std::string_view rule) { return inputs(rule).only("inputs()"); }

OutputSimplex Simplex::output(std::string_view rule) { return outputs(rule).only("outputs()"); }

RelatedList<InputSimplex> Simplex::inputs(std::string_view rule) {
    std::vector<InputSimplex> related;
    for (const std::uint32_t edge : edgesUnder(rule, Direction::Input)) {
        related.emplace_back(*this, edge);
    }
    return {*this, rule, std::move(related)};
}

RelatedList<OutputSimplex> Simplex::outputs(std::string_view rule) {
    std::vector<OutputSimplex> related;
    for (const std::uint32_t edge : edgesUnder(rule, Direction::Output)) {
        related.emplace_back(*this, edge);
    }
    return {*this, rule, std::move(related)};
}

std::vector<std::uint32_t> Simplex::edgesUnder(std::string_view rule, Direction direction) const {
    ruleAt(type(), path(), rule, direction);
    return edgesOf(startedRuntime().structure(), index_, rule);
}

const ItemLayout& Simplex::parameter(std::string_view command, std::string_view parameter,
                                     Shape shape, bool request) const {
    const CommandTable& table = startedRuntime().commands(index_);
    const std::uint32_t found = table.find(command);
    if (found == CommandTable::none) throwNoCommand(*this, command);
    const auto& entry = table.entries[found];
    const RecordLayout& record = request ? entry.request : entry.response;
    const ItemLayout* layout = record.find(parameter);
    const std::string where = path() + ": " + (request ? "request" : "response") + " of command '" +
                              std::string{command} + "'";
    if (layout == nullptr) {
        std::vector<std::string> names;
        for (const ItemLayout& each : record.items) names.push_back(each.item->name);
        throwUnknown(where + " has no '" + std::string{parameter} + "'", parameter, names);
    }
    checkShape(*layout->item, {shape.kind, shape.array, false},
               where + ": '" + layout->item->name + "'");
    return *layout;
}

void Simplex::handle(std::string_view command, Handler handler) {
    AgentRuntime& agent = startedRuntime();
    if (type().findCommand(command) == nullptr) throwNoCommand(*this, command);
    if (lifeCycleCommand(command) != LifeCycle::None) {
        throw Error(path() + ": '" + std::string{command} + "' is carried out by the framework");
    }
    agent.registerHandler(index_, command, handler);
}

}  // namespace cortex
