// SPDX-License-Identifier: Apache-2.0
#include "wire/named_values.hpp"

#include <cstring>
#include <utility>

namespace cortex::comms {

NamedValue namedValue(const std::string& name, const Value& value) {
    NamedValue named;
    named.name = name;
    named.kind = cortex::name(kindOf(value));
    switch (kindOf(value)) {
        case Kind::Int:
            named.ints = std::get<std::vector<std::int64_t>>(value);
            break;
        case Kind::Float:
            named.floats = std::get<std::vector<double>>(value);
            break;
        case Kind::Bool:
            named.bools = std::get<std::vector<bool>>(value);
            break;
        case Kind::String:
            named.strings = std::get<std::vector<std::string>>(value);
            // Values are kept as they would arrive: a NUL ends a text on the wire.
            for (std::string& text : named.strings) text.resize(std::strlen(text.c_str()));
            break;
    }
    return named;
}

std::vector<NamedValue> namedValues(const std::map<std::string, Value>& values) {
    std::vector<NamedValue> named;
    for (const auto& [name, value] : values) named.push_back(namedValue(name, value));
    return named;
}

std::optional<Value> valueOf(const NamedValue& named) {
    const auto kind = kindFromName(named.kind);
    if (!kind) return {};
    const std::size_t elements =
        named.ints.size() + named.floats.size() + named.bools.size() + named.strings.size();
    Value value;
    switch (*kind) {
        case Kind::Int:
            value = named.ints;
            break;
        case Kind::Float:
            value = named.floats;
            break;
        case Kind::Bool:
            value = named.bools;
            break;
        case Kind::String:
            value = named.strings;
            break;
    }
    if (lengthOf(value) != elements) return {};
    return value;
}

std::optional<std::map<std::string, Value>> valuesOf(const std::vector<NamedValue>& named) {
    std::map<std::string, Value> values;
    for (const NamedValue& each : named) {
        auto value = valueOf(each);
        if (!value || !values.emplace(each.name, std::move(*value)).second) return {};
    }
    return values;
}

}  // namespace cortex::comms
