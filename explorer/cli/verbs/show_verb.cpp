// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/labelled_value.hpp"

#include "common/cut_text.hpp"
#include "common/live_rule.hpp"
#include "common/shown_age.hpp"
#include "live/causes.hpp"
#include "live/live_json.hpp"
#include "live/live_values.hpp"
#include "live/loop_text.hpp"
#include "live/safe_demand.hpp"
#include "verbs/live_verbs.hpp"

#include <cmath>
#include <iostream>

namespace cortex::cli {
namespace {

// Everything about one simplex at one moment.
struct Shown {
    FoundSimplex simplex;
    comms::AgentImage image;
    std::optional<double> age;  // s; none: no values ever came, or none was measured
    comms::AgentStatus owner{};
    std::vector<Cause> causes{};
    StaleDemand demand{};

    Value value(const ItemLayout& item) const { return image->value(simplex.index, item); }
    bool knows(const DataItem& item) const {
        return item.constant ||
               (image.came(simplex.index) && !common::neverCame(image, simplex.index, item));
    }
    bool neverMeasured() const { return common::neverMeasured(image, simplex.index); }
    // None also of a lost agent: its last state may be over.
    std::optional<State> state() const {
        return image.lost() ? std::nullopt : stateOf(image, simplex.index);
    }
    bool isLive(const DataItem& item) const {
        return common::isLive(owner, image, simplex.index, demand.safe, item);
    }
    Quality quality() const { return image->state(simplex.index).quality; }
};

// Why a command would be refused now; "" if it would be taken.
std::string refusal(const Shown& shown, const CommandTable::Entry& entry) {
    if (shown.simplex.info().role != Role::Active) return "";
    if (entry.available == StateSet::always()) return "";  // an agent itself has no state
    const auto state = shown.state();
    if (!state) return "its state is not known";
    if (entry.available.has(*state)) return "";
    return "needs " + entry.available.text() + ", is " + name(*state);
}

Json parameterJson(const DataItem& item) {
    Json labels = Json::object();
    for (const auto& [number, label] : item.labels) labels[toText(number)] = label;
    return {{"name", item.name}, {"kind", name(item.kind)},        {"length", item.length},
            {"unit", item.unit}, {"min", numberJson(item.min)},    {"max", numberJson(item.max)},
            {"labels", labels},  {"description", item.description}};
}

Json recordJson(const RecordLayout& record) {
    Json list = Json::array();
    for (const ItemLayout& each : record.items) list.push_back(parameterJson(*each.item));
    return list;
}

bool isCut(const Shown& shown, const ItemLayout& each) {
    const Value value = shown.value(each);
    for (std::size_t i = 0; i < lengthOf(value); ++i) {
        if (common::mayBeCut(*each.item, value, i)) return true;
    }
    return false;
}

// What stands behind a text that fills its item, so that it may go on.
std::string cutText(const Shown& shown, const ItemLayout& each) {
    if (!isCut(shown, each)) return "";
    const bool isFault = each.item->name == "faultText";
    return isFault ? "…  <- the rest: cortex events " + shown.simplex.info().path : "…";
}

Json dataJson(const Shown& shown) {
    Json data = Json::object();
    for (const ItemLayout& each : shown.simplex.info().layout->items) {
        const DataItem& item = *each.item;
        const bool known = shown.knows(item);
        data[item.name] = {{"kind", name(item.kind)},
                           {"value", known ? valueJson(item, shown.value(each)) : Json()},
                           {"unit", item.unit},
                           {"min", numberJson(item.min)},
                           {"max", numberJson(item.max)},
                           {"description", item.description}};
        if (!known) continue;
        const Json label = labelJson(item, shown.value(each));
        if (!label.is_null()) data[item.name]["label"] = label;
        const std::string wrong = outsideText(item, shown.value(each));
        if (!wrong.empty()) data[item.name]["wrong"] = wrong;
        if (isCut(shown, each)) data[item.name]["cut"] = true;
    }
    return data;
}

bool isInput(const Edge& edge) { return edge.rule->direction == Direction::Input; }

Json relationshipsJson(const FoundSimplex& simplex) {
    Json list = Json::array();
    for (std::uint32_t i = 0; i < simplex.info().edgeCount; ++i) {
        const Edge& edge = simplex.structure->edges[simplex.info().firstEdge + i];
        list.push_back({{"rule", edge.rule->name},
                        {"direction", name(edge.rule->direction)},
                        {"to", simplex.structure->simplexes[edge.target].path},
                        {"max_age_s", isInput(edge) ? Json(edge.maxAge) : Json()}});
    }
    return list;
}

Json commandsJson(const Shown& shown, const CommandTable& table) {
    Json list = Json::array();
    for (const CommandTable::Entry& each : table.entries) {
        const std::string reason = refusal(shown, each);
        list.push_back({{"name", each.name},
                        {"available", reason.empty()},
                        {"reason", reason},
                        {"request", recordJson(each.request)},
                        {"response", recordJson(each.response)}});
    }
    return list;
}

Json causesJson(const std::vector<Cause>& causes) {
    Json list = Json::array();
    for (const Cause& each : causes) list.push_back({{"path", each.path}, {"agent", each.agent}});
    return list;
}

Json shownJson(const Shown& shown) {
    const Type& type = shown.simplex.type();
    const auto state = shown.state();
    return {{"path", shown.simplex.info().path},
            {"type", type.name},
            {"ancestors", type.ancestors},
            {"role", name(shown.simplex.info().role)},
            {"agent", shown.simplex.agent},
            {"quality", name(shown.quality())},
            {"safe", safeJson(shown.demand)},
            {"causes", causesJson(shown.causes)},
            {"age_ms", shown.age ? Json(*shown.age * 1000) : Json()},
            {"overloaded", shown.owner.overloaded},
            {"standstill", shown.owner.standstill},
            {"state", state ? Json(name(*state)) : Json()},
            {"data", dataJson(shown)},
            {"relationships", relationshipsJson(shown.simplex)},
            {"commands", commandsJson(shown, commandTable(type))}};
}

std::string rangeText(const DataItem& item) {
    if (!item.min && !item.max) return "";
    return (item.min ? toText(*item.min) : "") + " .. " + (item.max ? toText(*item.max) : "");
}

// For a look it is enough if nobody else is about to say that the path is his, too.
constexpr std::chrono::milliseconds othersAwaited{300};

std::string bracketed(const std::string& text) { return '[' + text + ']'; }

void printHead(const Shown& shown) {
    const FoundSimplex& simplex = shown.simplex;
    const auto state = shown.state();
    Columns columns{2};
    columns.add({"type", simplex.type().name});
    columns.add(
        {"is a", joined({simplex.type().ancestors.begin(), simplex.type().ancestors.end()})});
    columns.add({"role", name(simplex.info().role)});
    const std::string trouble = loopTrouble(shown.owner);
    columns.add({"agent", simplex.agent + (trouble.empty() ? "" : ", " + trouble)});
    const auto last = stateOf(shown.image, simplex.index);
    if (last) columns.add({"state", state ? name(*state) : bracketed(name(*last))});
    const std::string& why = shown.demand.why;
    std::string quality = name(shown.quality());
    if (shown.neverMeasured()) quality += ", never measured";
    if (!why.empty()) quality += (shown.demand.safe ? ", its safe value: " : ", ") + why;
    columns.add({"quality", quality});
    if (!shown.causes.empty()) columns.add({"because of", causesText(shown.causes)});
    if (shown.age) columns.add({"age", toText(std::round(*shown.age * 1e4) / 10) + " ms"});
    std::cout << simplex.info().path << '\n';
    columns.print(std::cout);
}

// What is not live stands in brackets; what never came is not shown as if it had.
std::string shownText(const Shown& shown, const ItemLayout& each) {
    const DataItem& item = *each.item;
    if (!shown.knows(item)) return "-";
    const Value value = shown.value(each);
    const std::string text = valueText(item, value) + cutText(shown, each) + wrongText(item, value);
    return shown.isLive(item) ? text : bracketed(text);
}

void printData(const Shown& shown) {
    Columns columns{2};
    for (const ItemLayout& each : shown.simplex.info().layout->items) {
        const DataItem& item = *each.item;
        columns.add(
            {item.name, shownText(shown, each), item.unit, rangeText(item), item.description});
    }
    std::cout << "\ndata\n";
    columns.print(std::cout);
}

void printRelationships(const FoundSimplex& simplex) {
    if (simplex.info().edgeCount == 0) return;
    Columns columns{2};
    for (std::uint32_t i = 0; i < simplex.info().edgeCount; ++i) {
        const Edge& edge = simplex.structure->edges[simplex.info().firstEdge + i];
        const bool hasOwnAge = isInput(edge) && edge.maxAge != edge.rule->maxAge;
        columns.add({edge.rule->name, isInput(edge) ? "<-" : "->",
                     simplex.structure->simplexes[edge.target].path,
                     hasOwnAge ? "max age " + toText(edge.maxAge) + " s" : ""});
    }
    std::cout << "\nrelationships\n";
    columns.print(std::cout);
}

void printCommands(const Shown& shown, const CommandTable& table) {
    if (table.entries.empty()) return;
    Columns columns{2};
    for (const CommandTable::Entry& each : table.entries) {
        std::vector<std::string> parameters;
        for (const ItemLayout& item : each.request.items)
            parameters.push_back(item.item->name + "=");
        columns.add({std::string{each.name}, joined(parameters, " "), refusal(shown, each)});
    }
    std::cout << "\ncommands\n";
    columns.print(std::cout);
}

StaleDemand demandOf(Live& live, const Shown& shown) {
    const SlotState& state = shown.image->state(shown.simplex.index);
    const auto writer = common::staleBy(shown.simplex.info(), state);
    if (!writer) return {};
    const auto image = live.values({shown.simplex.agent, shown.simplex.structure, *writer});
    return safeBecause(shown.simplex.index, state, image);
}

// The FieldbusDevices that write an observation: they tell whether it was ever measured.
std::vector<std::uint32_t> devicesOf(const FoundSimplex& shown) {
    std::vector<std::uint32_t> devices;
    if (shown.info().role != Role::Observation) return devices;
    for (const std::uint32_t writer : shown.info().writers) {
        const SimplexInfo& info = shown.structure->simplexes[writer];
        if (!info.remote && info.layout->type->isA("FieldbusDevice")) devices.push_back(writer);
    }
    return devices;
}

void printHint(const Shown& shown) {
    if (shown.state() != State::Fault || !shown.owner.remembers) return;
    std::cout << "\ncortex events --before-fault " << shown.simplex.info().path
              << " shows the ten seconds before\n";
}

}  // namespace

Exit showSimplex(const ShowOptions& options) {
    checkPath(options.path);
    Live live{options.network};
    live.view({options.path}, 100);
    Shown shown{live.find(options.path, othersAwaited), {}, {}};
    shown.image = live.values(shown.simplex, devicesOf(shown.simplex));
    shown.owner = live.statusOf(shown.simplex.agent);
    shown.age = live.mirror().age(shown.simplex.agent, shown.simplex.index);
    if (shown.neverMeasured()) shown.age.reset();
    if (shown.age) shown.age = common::shownAge(*shown.age, shown.owner);
    shown.demand = demandOf(live, shown);
    shown.causes = causesOf(live, shown.simplex, shown.image);
    if (options.json) {
        Json json = shownJson(shown);
        if (const auto contest = live.contestOf(options.path)) {
            json["contested"] = contestedJson(*contest);
        }
        print(json);
        return Yes;
    }
    printHead(shown);
    printData(shown);
    printRelationships(shown.simplex);
    printCommands(shown, commandTable(shown.simplex.type()));
    printHint(shown);
    return Yes;
}

}  // namespace cortex::cli
