// SPDX-License-Identifier: Apache-2.0
#include "model/remedies.hpp"

#include "cortex/core/xml_text.hpp"

#include <algorithm>

namespace cortex {

std::string relateText(std::string_view rule, std::string_view to, std::string_view more) {
    std::string text =
        "<relate rule=\"" + xmlAttribute(rule) + "\" to=\"" + xmlAttribute(to) + "\"";
    if (!more.empty()) text += " " + std::string{more};
    return text + "/>";
}

std::string relateText(const Simplex::Relation& relation) {
    std::string more;
    const auto add = [&more](const std::string& name, const std::string& value) {
        more += (more.empty() ? "" : " ") + name + "=\"" + xmlAttribute(value) + "\"";
    };
    if (relation.remote) add("remote", "true");
    if (!relation.type.empty()) add("type", relation.type);
    if (relation.delayed) add("delayed", "true");
    if (relation.maxAge > 0) add("maxAge", toText(relation.maxAge));
    return relateText(relation.rule, relation.target, more);
}

std::string relateText(Simplex::Relation relation, const std::string& rule, const std::string& to) {
    relation.rule = rule;
    relation.target = to;
    return relateText(relation);
}

std::string setText(std::string_view item, std::string_view value) {
    return setElement(item, value);
}

std::string valueText(const Value& value) {
    const auto* strings = std::get_if<std::vector<std::string>>(&value);
    return strings != nullptr && strings->size() == 1 ? strings->front() : toText(value);
}

std::string listText(const std::vector<std::string>& names, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
    return text;
}

std::vector<std::string> concreteTypes(const TypeModel& types, std::string_view base) {
    std::vector<std::string> names;
    for (const auto& [name, type] : types.types()) {
        if (!type.isAbstract && type.isA(base)) names.push_back(name);
    }
    return names;
}

}  // namespace cortex
