// SPDX-License-Identifier: Apache-2.0
#include "wire/type_messages.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {
namespace {

using Described = std::vector<DescribedAttribute>;

std::string take(Described& attributes, std::string_view name, std::string_view otherwise = {}) {
    const auto found = std::ranges::find(attributes, name, &DescribedAttribute::name);
    if (found == attributes.end()) return std::string{otherwise};
    std::string text = found->text;
    attributes.erase(found);
    return text;
}

std::uint32_t takeNumber(Described& attributes, std::string_view name, std::uint32_t otherwise) {
    const std::string text = take(attributes, name);
    std::from_chars(text.data(), text.data() + text.size(), otherwise);
    return otherwise;
}

std::vector<Attribute> attributeMessages(const Described& attributes) {
    std::vector<Attribute> messages;
    for (const auto& each : attributes) messages.push_back({each.name, each.text});
    return messages;
}

// The attributes that have no fields of their own.
Described described(const std::vector<Attribute>& messages,
                    std::initializer_list<std::string_view> fields = {}) {
    Described attributes;
    for (const Attribute& each : messages) {
        if (std::ranges::count(fields, each.name) > 0) continue;
        attributes.push_back({each.name, each.value});
    }
    return attributes;
}

DataItemModel dataMessage(const DescribedItem& item) {
    const DataItemModel plain;
    Described rest = item.attributes;
    DataItemModel message;
    message.name = item.name;
    message.kind = take(rest, "kind");
    message.length = takeNumber(rest, "length", plain.length);
    message.capacity = takeNumber(rest, "capacity", plain.capacity);
    message.unit = take(rest, "unit");
    message.constant = take(rest, "constant") == "true";
    message.description = item.description;
    message.attributes = attributeMessages(rest);
    return message;
}

DescribedItem dataDescription(const DataItemModel& message) {
    const DataItemModel plain;
    DescribedItem item;
    item.name = message.name;
    item.description = message.description;
    item.attributes =
        described(message.attributes, {"kind", "length", "capacity", "unit", "constant"});
    const auto add = [&](const char* name, std::string value) {
        item.attributes.push_back({name, std::move(value)});
    };
    add("kind", message.kind);
    if (message.length != plain.length) add("length", std::to_string(message.length));
    if (message.capacity != plain.capacity) add("capacity", std::to_string(message.capacity));
    if (!message.unit.empty()) add("unit", message.unit);
    if (message.constant) add("constant", "true");
    return item;
}

// The description of a parameter is one of its attributes.
std::vector<Parameter> parameterMessages(const std::vector<DescribedItem>& items) {
    std::vector<Parameter> messages;
    for (const DescribedItem& each : items) {
        messages.push_back({each.name, attributeMessages(each.attributes)});
        if (each.description.empty()) continue;
        messages.back().attributes.push_back({"description", each.description});
    }
    return messages;
}

std::vector<DescribedItem> parameterDescriptions(const std::vector<Parameter>& messages) {
    std::vector<DescribedItem> items;
    for (const Parameter& each : messages) {
        DescribedItem item;
        item.name = each.name;
        item.attributes = described(each.attributes);
        item.description = take(item.attributes, "description");
        items.push_back(std::move(item));
    }
    return items;
}

CommandModel commandMessage(const DescribedCommand& command) {
    return {command.name, command.description, attributeMessages(command.attributes),
            parameterMessages(command.request), parameterMessages(command.response)};
}

DescribedCommand commandDescription(const CommandModel& message) {
    DescribedCommand command;
    command.name = message.name;
    command.description = message.description;
    command.attributes = described(message.attributes);
    command.request = parameterDescriptions(message.request);
    command.response = parameterDescriptions(message.response);
    return command;
}

RuleModel ruleMessage(const DescribedRule& rule) {
    Described rest = rule.attributes;
    RuleModel message;
    message.name = rule.name;
    message.direction = take(rest, "direction", "input");
    message.target = take(rest, "target");
    message.description = rule.description;
    message.attributes = attributeMessages(rest);
    return message;
}

DescribedRule ruleDescription(const RuleModel& message) {
    DescribedRule rule;
    rule.name = message.name;
    rule.description = message.description;
    rule.attributes = described(message.attributes, {"direction", "target"});
    rule.attributes.push_back({"direction", message.direction});
    rule.attributes.push_back({"target", message.target});
    return rule;
}

template <class From, class Make>
auto all(const std::vector<From>& list, Make make) {
    std::vector<decltype(make(list.front()))> result;
    for (const From& each : list) result.push_back(make(each));
    return result;
}

}  // namespace

TypeMessage typeMessage(const TypeDescription& type) {
    TypeMessage message;
    message.name = type.name;
    message.hash = type.hash;
    message.parents = type.parents;
    message.description = type.description;
    message.attributes = attributeMessages(type.attributes);
    message.data = all(type.data, dataMessage);
    message.commands = all(type.commands, commandMessage);
    message.rules = all(type.rules, ruleMessage);
    return message;
}

TypeDescription typeDescription(const TypeMessage& message) {
    TypeDescription type;
    type.name = message.name;
    type.hash = message.hash;
    type.parents = message.parents;
    type.description = message.description;
    type.attributes = described(message.attributes);
    type.data = all(message.data, dataDescription);
    type.commands = all(message.commands, commandDescription);
    type.rules = all(message.rules, ruleDescription);
    return type;
}

}  // namespace cortex::comms
