// SPDX-License-Identifier: Apache-2.0
#include "types/type_attributes.hpp"

#include "types/type_merge.hpp"

#include <algorithm>

namespace cortex {

namespace {

std::string truth(bool value) { return value ? "true" : "false"; }

// Free text in double quotes; \ " and line ends are escaped.
std::string literal(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n') {
            result += "\\n";
        } else if (c == '\r') {
            result += "\\r";
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string valueText(const Value& value) {
    const auto* strings = std::get_if<std::vector<std::string>>(&value);
    if (!strings) return toText(value);
    std::string result;
    for (const std::string& each : *strings) result += (result.empty() ? "" : " ") + literal(each);
    return result;
}

std::string safeText(const Safe& safe) {
    switch (safe.kind) {
        case Safe::Kind::None:
            return "";
        case Safe::Kind::Given:
            return "value " + valueText(safe.value);
        case Safe::Kind::Hold:
            return "hold";
        case Safe::Kind::Observed:
            return "observed";
        case Safe::Kind::Stop:
            return "stop";
    }
    return "";
}

template <class T>
std::string optionalText(const std::optional<T>& number) {
    return number ? toText(*number) : "";
}

std::string freeText(const std::string& text) { return text.empty() ? "" : literal(text); }

// With those of a later version, each at its place; labels count as "label".
std::vector<TypeAttribute> with(const UnknownAttributes& unknown,
                                std::vector<TypeAttribute> attributes) {
    for (const auto& [name, text] : unknown) {
        const auto behind = std::ranges::find_if(attributes, [&](const TypeAttribute& each) {
            return std::string_view{each.name}.substr(0, each.name.find(' ')) > name;
        });
        attributes.insert(behind, {name, literal(text), ""});
    }
    return attributes;
}

}  // namespace

std::string countText(std::uint32_t count) {
    return count == Rule::many ? "*" : std::to_string(count);
}

std::string joined(const std::vector<std::string>& names) {
    std::string result;
    for (const std::string& each : names) result += (result.empty() ? "" : " ") + each;
    return result;
}

std::vector<TypeAttribute> attributesOf(const Type& type) {
    const Type plain;
    std::vector<std::string> parents = type.parents;
    std::ranges::sort(parents);
    return with(type.unknown, {{"abstract", truth(type.isAbstract), "false"},
                               {"extends", joined(parents), ""},
                               {"icon", freeText(type.icon), ""},
                               {"measures", truth(type.measures), "false"},
                               {"onLeaseLost", name(type.onLeaseLost), name(plain.onLeaseLost)},
                               {"replaces", freeText(type.replaces), ""},
                               {"role", name(type.role), name(plain.role)},
                               {"since", freeText(type.since), ""},
                               {"transitionTimeout", toText(type.transitionTimeout),
                                toText(plain.transitionTimeout)},
                               {"version", freeText(type.version), ""},
                               {"writers", type.manyWriters ? "many" : "one", "one"}});
}

std::vector<TypeAttribute> attributesOf(const DataItem& item) {
    const DataItem plain;
    std::vector<TypeAttribute> result{
        // Quoted, as agents hand it on that do not know it.
        {"above", freeText(item.above), ""},
        {"atRest", name(item.atRest), name(plain.atRest)},
        {"capacity", std::to_string(item.capacity), std::to_string(plain.capacity)},
        {"constant", truth(item.constant), "false"},
        {"deadband", toText(item.deadband), "0"},
        {"default", valueText(item.initial), valueText(implicitValue(item))},
        {"derivativeOf", item.derivativeOf, ""},
        {"format", freeText(item.format), ""},
        {"kind", name(item.kind), name(plain.kind)}};
    for (const auto& [number, label] : item.labels) {
        result.push_back({"label " + toText(number), literal(label), ""});
    }
    const std::vector<TypeAttribute> rest{{"length", std::to_string(item.length), "1"},
                                          {"max", optionalText(item.max), ""},
                                          {"measured", truth(item.measured), "false"},
                                          {"min", optionalText(item.min), ""},
                                          {"onLimit", name(item.onLimit), name(plain.onLimit)},
                                          {"rate", optionalText(item.rate), ""},
                                          {"resolution", toText(item.resolution), "0"},
                                          {"retain", truth(item.retain), "false"},
                                          {"safe", safeText(item.safe), ""},
                                          {"settable", item.settable.text(), ""},
                                          {"unit", item.unit, ""}};
    result.insert(result.end(), rest.begin(), rest.end());
    return with(item.unknown, std::move(result));
}

std::vector<TypeAttribute> attributesOf(const Command& command) {
    const Command plain;
    return with(command.unknown,
                {{"available", command.available.text(), plain.available.text()},
                 {"confirm", truth(command.confirm), "false"},
                 {"long", truth(command.isLong), "false"},
                 {"onBusy", name(command.onBusy), name(plain.onBusy)},
                 {"onInputLost", name(command.onInputLost), name(plain.onInputLost)},
                 {"onSenderLost", name(command.onSenderLost), name(plain.onSenderLost)},
                 {"repeated", truth(command.repeated), "false"},
                 {"stops", truth(command.stops), "false"},
                 {"timeout", toText(command.timeout), "0"}});
}

std::vector<TypeAttribute> attributesOf(const Rule& rule) {
    const Rule plain;
    return with(rule.unknown, {{"counterpart", rule.counterpart, ""},
                               {"create", joined(rule.create), ""},
                               {"delayed", truth(rule.delayed), "false"},
                               {"direction", name(rule.direction), name(plain.direction)},
                               {"max", countText(rule.max), "*"},
                               {"maxAge", toText(rule.maxAge), toText(plain.maxAge)},
                               {"min", countText(rule.min), "0"},
                               {"onLoss", name(rule.onLoss), name(plain.onLoss)},
                               {"refines", rule.refines, ""},
                               {"sameCount", rule.sameCount, ""},
                               {"target", rule.target, ""}});
}

}  // namespace cortex
