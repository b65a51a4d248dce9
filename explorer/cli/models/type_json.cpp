// SPDX-License-Identifier: Apache-2.0
#include "models/type_json.hpp"

#include "cortex/core/agreement.hpp"

#include <algorithm>
#include <array>

namespace cortex::cli {
namespace {

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json numberJson(const std::optional<Number>& number) {
    if (!number) return {};
    return std::visit([](auto value) { return Json(value); }, *number);
}

Json valueJson(const Value& value, std::uint32_t length) {
    Json list = std::visit([](const auto& elements) { return Json(elements); }, value);
    return length == 1 && list.size() == 1 ? Json(list.front()) : list;
}

Json safeJson(const DataItem& item) {
    switch (item.safe.kind) {
        case Safe::Kind::None:
            return {};
        case Safe::Kind::Hold:
            return "hold";
        case Safe::Kind::Observed:
            return "observed";
        case Safe::Kind::Stop:
            return "stop";
        case Safe::Kind::Given:
            break;
    }
    return valueJson(item.safe.value, item.length);
}

Json statesJson(StateSet states) {
    constexpr std::array all{State::Standby, State::StartingUp, State::Active, State::ShuttingDown,
                             State::Fault};
    Json list = Json::array();
    for (const State state : all) {
        if (states.has(state)) list.push_back(name(state));
    }
    return list;
}

Json parameterJson(const DataItem& item) {
    Json labels = Json::object();
    for (const auto& [number, label] : item.labels) labels[toText(number)] = label;
    return {{"name", item.name},
            {"kind", name(item.kind)},
            {"length", item.length},
            {"capacity", item.kind == Kind::String ? Json(item.capacity) : Json()},
            {"unit", item.unit},
            {"min", numberJson(item.min)},
            {"max", numberJson(item.max)},
            {"default", valueJson(item.initial, item.length)},
            {"labels", labels},
            {"description", item.description}};
}

Json parametersJson(const std::vector<DataItem>& items) {
    Json list = Json::array();
    for (const DataItem& item : items) list.push_back(parameterJson(item));
    return list;
}

void addOrigin(Json& json, const std::string& definedBy, const Place& place) {
    json["defined_by"] = definedBy;
    json["file"] = place.file;
    json["line"] = place.line;
}

Json dataJson(const DataItem& item) {
    Json json = parameterJson(item);
    json["safe"] = safeJson(item);
    json["on_limit"] = name(item.onLimit);
    json["at_rest"] = name(item.atRest);
    json["rate"] = orNull(item.rate);
    json["derivative_of"] = item.derivativeOf;
    json["above"] = item.above;
    json["settable"] = statesJson(item.settable);
    json["constant"] = item.constant;
    json["measured"] = item.measured;
    json["retain"] = item.retain;
    json["resolution"] = item.resolution;
    json["deadband"] = item.deadband;
    json["format"] = item.format;
    addOrigin(json, item.definedBy, item.place);
    return json;
}

Json commandJson(const Command& command) {
    Json json{{"name", command.name},
              {"description", command.description},
              {"available", statesJson(command.available)},
              {"long", command.isLong},
              {"timeout_s", command.timeout > 0 ? Json(command.timeout) : Json()},
              {"confirm", command.confirm},
              {"stops", command.stops},
              {"repeated", command.repeated},
              {"on_busy", name(command.onBusy)},
              {"on_input_lost", name(command.onInputLost)},
              {"on_sender_lost", name(command.onSenderLost)},
              {"request", parametersJson(command.request)},
              {"response", parametersJson(command.response)}};
    addOrigin(json, command.definedBy, command.place);
    return json;
}

Json ruleJson(const Rule& rule) {
    const bool input = rule.direction == Direction::Input;
    Json json{{"name", rule.name},
              {"direction", name(rule.direction)},
              {"target", rule.target},
              {"min", rule.min},
              {"max", rule.max == Rule::many ? Json() : Json(rule.max)},
              {"create", rule.create},
              {"delayed", rule.delayed},
              {"refines", rule.refines},
              {"counterpart", rule.counterpart},
              {"same_count", rule.sameCount},
              {"on_loss", input ? Json(name(rule.onLoss)) : Json()},
              {"max_age_s", input ? Json(rule.maxAge) : Json()},
              {"description", rule.description}};
    addOrigin(json, rule.definedBy, rule.place);
    return json;
}

template <class Element, class Function>
Json listJson(const std::vector<Element>& elements, Function function) {
    Json list = Json::array();
    for (const Element& element : elements) list.push_back(function(element));
    return list;
}

}  // namespace

std::vector<std::string> childrenOf(const TypeModel& types, const Type& type) {
    std::vector<std::string> children;
    for (const auto& [childName, child] : types.types()) {
        if (std::ranges::count(child.parents, type.name) > 0) children.push_back(childName);
    }
    return children;
}

Json typeSummaryJson(const Type& type) {
    return {{"name", type.name},
            {"parents", type.parents},
            {"abstract", type.isAbstract},
            {"role", name(type.role)},
            {"description", type.description},
            {"hash", toHex(typeHash(type))},
            {"file", type.place.file},
            {"line", type.place.line}};
}

Json typeJson(const TypeModel& types, const Type& type) {
    Json json = typeSummaryJson(type);
    json["version"] = type.version;
    json["ancestors"] = type.ancestors;
    json["children"] = childrenOf(types, type);
    json["many_writers"] = type.manyWriters;
    json["measures"] = type.measures;
    json["on_lease_lost"] = name(type.onLeaseLost);
    json["transition_timeout_s"] = type.transitionTimeout;
    json["icon"] = type.icon;
    json["since"] = type.since;
    json["replaces"] = type.replaces;
    json["data"] = listJson(type.data, dataJson);
    json["commands"] = listJson(type.commands, commandJson);
    json["rules"] = listJson(type.rules, ruleJson);
    return json;
}

}  // namespace cortex::cli
