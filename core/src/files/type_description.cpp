// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/type_description.hpp"

#include "types/type_attributes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace cortex {

namespace {

using Attributes = std::vector<DescribedAttribute>;

// What canonical text writes otherwise than XML.
bool isSpelled(std::string_view attribute) {
    constexpr std::array<std::string_view, 9> names{
        "above", "default", "extends", "format", "icon", "replaces", "safe", "since", "version"};
    return attribute.starts_with("label ") || std::ranges::find(names, attribute) != names.end();
}

// What canonical text and XML write alike, with what is spelled here and what is unknown.
Attributes attributesFrom(const std::vector<TypeAttribute>& canonical,
                          const UnknownAttributes& unknown, Attributes spelled) {
    for (const auto& [name, text] : unknown) spelled.push_back({name, text});
    constexpr std::array<std::string_view, 3> always{"direction", "kind", "target"};
    for (const TypeAttribute& each : canonical) {
        if (isSpelled(each.name) || unknown.contains(each.name)) continue;
        const bool given = each.stated() || std::ranges::find(always, each.name) != always.end();
        if (given) spelled.push_back({each.name, each.value});
    }
    std::ranges::sort(spelled, {}, &DescribedAttribute::name);
    return spelled;
}

void addText(Attributes& attributes, const char* name, const std::string& text) {
    if (!text.empty()) attributes.push_back({name, text});
}

std::string labelsText(const DataItem& item) {
    std::string text;
    for (const auto& [number, label] : item.labels) {
        text += (text.empty() ? "" : " ") + toText(number) + ":" + label;
    }
    return text;
}

std::string safeText(const Safe& safe) {
    switch (safe.kind) {
        case Safe::Kind::None:
            break;
        case Safe::Kind::Given:
            return toText(safe.value);
        case Safe::Kind::Hold:
            return "hold";
        case Safe::Kind::Observed:
            return "observed";
        case Safe::Kind::Stop:
            return "stop";
    }
    return "";
}

DescribedItem describe(const DataItem& item) {
    Attributes spelled;
    // Even if it is the implicit one: a parent may have another.
    if (item.hasDefault) spelled.push_back({"default", toText(item.initial)});
    if (item.safe.kind != Safe::Kind::None) spelled.push_back({"safe", safeText(item.safe)});
    addText(spelled, "above", item.above);
    addText(spelled, "format", item.format);
    addText(spelled, "labels", labelsText(item));
    return {item.name, attributesFrom(attributesOf(item), item.unknown, std::move(spelled)),
            item.description};
}

std::vector<DescribedItem> describe(const std::vector<DataItem>& items) {
    std::vector<DescribedItem> described;
    for (const DataItem& each : items) described.push_back(describe(each));
    return described;
}

DescribedCommand describe(const Command& command) {
    return {command.name, command.description,
            attributesFrom(attributesOf(command), command.unknown, {}), describe(command.request),
            describe(command.response)};
}

DescribedRule describe(const Rule& rule) {
    return {rule.name, rule.description, attributesFrom(attributesOf(rule), rule.unknown, {})};
}

}  // namespace

TypeDescription describe(const Type& type) {
    TypeDescription described;
    described.name = type.name;
    described.hash = typeHash(type);
    described.parents = type.parents;
    described.description = type.description;
    Attributes spelled;
    addText(spelled, "icon", type.icon);
    addText(spelled, "replaces", type.replaces);
    addText(spelled, "since", type.since);
    addText(spelled, "version", type.version);
    described.attributes = attributesFrom(attributesOf(type), type.unknown, std::move(spelled));
    described.data = describe(type.data);
    for (const Command& each : type.commands) described.commands.push_back(describe(each));
    for (const Rule& each : type.rules) described.rules.push_back(describe(each));
    return described;
}

std::vector<const Type*> closureOf(const TypeModel& model, std::span<const std::string> names) {
    std::map<std::string_view, const Type*> closed;
    std::vector<const Type*> waiting;
    const auto need = [&](std::string_view name) {
        const Type* type = model.find(name);
        if (type != nullptr && closed.emplace(type->name, type).second) waiting.push_back(type);
    };
    for (const std::string& name : names) need(name);
    while (!waiting.empty()) {
        const Type& type = *waiting.back();
        waiting.pop_back();
        for (const std::string& ancestor : type.ancestors) need(ancestor);
        for (const Rule& rule : type.rules) {
            need(rule.target);
            for (const std::string& created : rule.create) need(created);
        }
    }
    std::vector<const Type*> result;
    for (const auto& [name, type] : closed) result.push_back(type);
    return result;
}

}  // namespace cortex
