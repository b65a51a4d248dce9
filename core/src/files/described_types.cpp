// SPDX-License-Identifier: Apache-2.0
#include "files/described_types.hpp"

#include "base/text.hpp"
#include "types/type_attributes.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cortex {

namespace {

using Attributes = std::vector<DescribedAttribute>;
using Parents = std::vector<const Attributes*>;

const std::string* find(const Attributes& attributes, std::string_view name) {
    const auto found = std::ranges::find(attributes, name, &DescribedAttribute::name);
    return found == attributes.end() ? nullptr : &found->text;
}

// The labels that no parent has. One that says more than the child says other things.
std::string newLabels(const std::string& own, const Parents& parents) {
    std::set<std::string_view> inherited;
    for (const Attributes* parent : parents) {
        const std::string* labels = find(*parent, "labels");
        if (labels == nullptr || labels->size() > own.size()) continue;
        for (const std::string_view each : splitBlanks(*labels)) inherited.insert(each);
    }
    std::string result;
    for (const std::string_view each : splitBlanks(own)) {
        if (inherited.contains(each)) continue;
        result.append(result.empty() ? "" : " ").append(each);
    }
    return result;
}

// Of a new item everything, of an inherited one what not all parents say.
Attributes beside(const Attributes& own, const Parents& parents) {
    Attributes result;
    for (const DescribedAttribute& each : own) {
        const auto says = [&](const Attributes* parent) {
            const std::string* text = find(*parent, each.name);
            return text != nullptr && *text == each.text;
        };
        if (!parents.empty() && std::ranges::all_of(parents, says)) continue;
        if (each.name != "labels" || parents.empty()) {
            result.push_back(each);
        } else if (std::string labels = newLabels(each.text, parents); !labels.empty()) {
            result.push_back({each.name, std::move(labels)});
        }
    }
    return result;
}

// The defaults of what a parent says and the child does not: left out, they would be inherited.
Attributes defaultsOver(const Attributes& own, const Parents& parents,
                        const std::vector<TypeAttribute>& known) {
    Attributes result;
    for (const TypeAttribute& each : known) {
        const auto says = [&](const Attributes* parent) { return find(*parent, each.name); };
        const bool unsaid = each.byDefault.empty() || each.name == "default" ||
                            find(own, each.name) || std::ranges::none_of(parents, says);
        if (!unsaid) result.push_back({each.name, each.byDefault});
    }
    return result;
}

XmlElement element(const char* kind, const char* nameAttribute, const std::string& name) {
    XmlElement result;
    result.name = kind;
    result.attributes.push_back({nameAttribute, name});
    return result;
}

void addTo(XmlElement& element, const Attributes& attributes) {
    for (const DescribedAttribute& each : attributes) {
        element.attributes.push_back({each.name, each.text});
    }
}

// An item with what it states; its children are added by the caller.
template <class Item>
XmlElement stating(const char* kind, const Item& own, const std::vector<const Item*>& parents,
                   const std::vector<TypeAttribute>& known) {
    XmlElement result = element(kind, "name", own.name);
    Parents attributes;
    for (const Item* parent : parents) attributes.push_back(&parent->attributes);
    addTo(result, beside(own.attributes, attributes));
    addTo(result, defaultsOver(own.attributes, attributes, known));
    const auto same = [&](const Item* parent) { return parent->description == own.description; };
    const bool inherited = !parents.empty() && std::ranges::all_of(parents, same);
    if (!own.description.empty() && !inherited) {
        result.attributes.push_back({"description", own.description});
    }
    return result;
}

// An item that states nothing beside what all parents say is not written at all.
template <class Item>
void add(std::vector<XmlElement>& elements, XmlElement element,
         const std::vector<const Item*>& parents) {
    const bool says = element.attributes.size() > 1 || !element.children.empty();
    if (says || parents.empty()) elements.push_back(std::move(element));
}

void addParameters(XmlElement& command, const char* kind,
                   std::vector<DescribedItem> DescribedCommand::* list, const DescribedCommand& own,
                   const std::vector<const DescribedCommand*>& parents) {
    const std::vector<TypeAttribute> known = attributesOf(DataItem{});
    std::vector<std::map<std::string_view, const DescribedItem*>> inherited(parents.size());
    for (std::size_t i = 0; i < parents.size(); ++i) {
        for (const DescribedItem& each : parents[i]->*list) inherited[i].emplace(each.name, &each);
    }
    for (const DescribedItem& each : own.*list) {
        std::vector<const DescribedItem*> same;
        for (const auto& parent : inherited) {
            const auto found = parent.find(each.name);
            if (found != parent.end()) same.push_back(found->second);
        }
        add(command.children, stating(kind, each, same, known), same);
    }
}

// The items of that name, one of each parent that has it.
template <class Known, class Item>
std::vector<const Item*> sameOf(const std::vector<const Known*>& parents,
                                std::map<std::string_view, const Item*> Known::* list,
                                std::string_view name) {
    std::vector<const Item*> result;
    for (const Known* parent : parents) {
        const auto found = (parent->*list).find(name);
        if (found != (parent->*list).end()) result.push_back(found->second);
    }
    return result;
}

}  // namespace

DescribedTypes::DescribedTypes(const std::vector<const TypeDescription*>& types) {
    for (const TypeDescription* type : types) {
        const auto [place, added] = known_.try_emplace(type->name);
        if (!added) continue;
        Known& known = place->second;
        known.type = type;
        for (const DescribedItem& each : type->data) known.data.emplace(each.name, &each);
        for (const DescribedCommand& each : type->commands) {
            known.commands.emplace(each.name, &each);
        }
        for (const DescribedRule& each : type->rules) known.rules.emplace(each.name, &each);
    }
}

std::vector<const DescribedTypes::Known*> DescribedTypes::parentsOf(
    const TypeDescription& described) const {
    std::vector<const Known*> parents;
    for (const std::string& parent : described.parents) {
        const auto found = known_.find(parent);
        if (found != known_.end()) parents.push_back(&found->second);
    }
    return parents;
}

XmlElement DescribedTypes::type(const TypeDescription& described) const {
    const std::vector<const Known*> parents = parentsOf(described);
    XmlElement result = element("type", "name", described.name);
    std::string extends;
    for (const std::string& each : described.parents)
        extends += (extends.empty() ? "" : " ") + each;
    if (!extends.empty()) result.attributes.push_back({"extends", extends});
    if (!described.description.empty()) {
        result.attributes.push_back({"description", described.description});
    }
    // Of a type's attributes some are inherited and some are not: all are stated.
    addTo(result, described.attributes);
    Parents theirs;
    for (const Known* parent : parents) theirs.push_back(&parent->type->attributes);
    addTo(result, defaultsOver(described.attributes, theirs, attributesOf(Type{})));

    const std::vector<TypeAttribute> knownOfData = attributesOf(DataItem{});
    for (const DescribedItem& each : described.data) {
        const auto same = sameOf(parents, &Known::data, each.name);
        add(result.children, stating("data", each, same, knownOfData), same);
    }
    const std::vector<TypeAttribute> knownOfCommands = attributesOf(Command{});
    for (const DescribedCommand& each : described.commands) {
        const auto same = sameOf(parents, &Known::commands, each.name);
        XmlElement command = stating("command", each, same, knownOfCommands);
        addParameters(command, "request", &DescribedCommand::request, each, same);
        addParameters(command, "response", &DescribedCommand::response, each, same);
        add(result.children, std::move(command), same);
    }
    return result;
}

XmlElement DescribedTypes::rules(const TypeDescription& described) const {
    const std::vector<const Known*> parents = parentsOf(described);
    const std::vector<TypeAttribute> known = attributesOf(Rule{});
    XmlElement result = element("rules", "type", described.name);
    for (const DescribedRule& each : described.rules) {
        const auto same = sameOf(parents, &Known::rules, each.name);
        add(result.children, stating("relationship", each, same, known), same);
    }
    return result;
}

}  // namespace cortex
