// SPDX-License-Identifier: Apache-2.0
#include "types/type_resolver.hpp"

#include "cortex/core/findings.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "types/above_checks.hpp"
#include "types/derivative_checks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex {

namespace {

std::string dataKey(std::string_view item) { return dataPrefix("", item); }

std::size_t costOf(const DataItem& item) {
    constexpr std::size_t least = 16;
    return std::max<std::size_t>(least, item.length) + item.labels.size();
}
std::size_t costOf(const Rule& rule) { return 16 + rule.create.size(); }
std::size_t costOf(const Command& command) {
    std::size_t cost = 16;
    for (const DataItem& each : command.request) cost += costOf(each);
    for (const DataItem& each : command.response) cost += costOf(each);
    return cost;
}

// Names of a list that are given once, with a finding for every other.
template <class Item>
std::map<std::string, const Item*> ownItems(const std::vector<Item>& own, const std::string& type,
                                            const char* what, const char* duplicate,
                                            Report& report) {
    std::map<std::string, const Item*> result;
    for (const Item& each : own) {
        if (!isName(each.name)) {
            report.error(type, finding::name, each.place,
                         what + inQuotes(each.name) + " is not a name",
                         "write a letter, then letters, digits, - or _; at most 64");
            continue;
        }
        const auto [known, added] = result.emplace(each.name, &each);
        if (added) continue;
        const std::string first = known->second->place.text();
        report.error(type, duplicate, each.place,
                     what + inQuotes(each.name) + " is given twice" +
                         (first.empty() ? "" : ", first at " + first),
                     "keep one of them");
    }
    return result;
}

// A role that both allow: descriptive is open to observation and modification. False: none.
bool joinRoles(Role& role, Role other) {
    if (role == other || other == Role::Descriptive) return role == other || role != Role::Active;
    if (role != Role::Descriptive || other == Role::Active) return false;
    role = other;
    return true;
}

}  // namespace

TypeResolver::TypeResolver(const Declarations& declarations, const std::vector<std::string>& order,
                           Report& report)
    : declarations_{declarations}, report_{report}, graph_{declarations, order, report} {}

TypeResolver::Types TypeResolver::run() {
    for (const std::string& name : graph_.order()) {
        types_.emplace(name, resolve(declarations_.find(name)->second));
    }
    for (const std::string& name : graph_.order()) {
        const Type& type = types_.find(name)->second;
        checkRules(type);
        checkBehaviour(type);
        checkUnits(type);
        checkItems(type);
    }
    return std::move(types_);
}

void TypeResolver::checkItems(const Type& type) {
    if (graph_.incomplete(type.name)) return;
    std::vector<const Type*> parents;
    for (const std::string& parent : type.parents) parents.push_back(&types_.find(parent)->second);
    checkDerivatives(type, parents, report_);
    checkAbove(type, parents, report_);
}

Type TypeResolver::resolve(const TypeDeclaration& declaration) {
    Type type;
    type.name = declaration.name;
    type.version = declaration.version;
    type.description = declaration.description;
    type.parents = graph_.parents(type.name);
    type.ancestors = graph_.ancestors(type.name);
    type.isAbstract = declaration.isAbstract;
    type.since = declaration.since;
    type.replaces = declaration.replaces;
    type.place = declaration.place;
    resolveRole(type, declaration);
    resolveFlags(type, declaration);
    type.data = mergeItems(&Type::data, declaration.data, declaration, "data ", dataKey,
                           finding::duplicateData, mergeData);
    type.commands = mergeItems(&Type::commands, declaration.commands, declaration, "command ",
                               commandPrefix, finding::duplicateCommand, mergeCommand);
    type.rules = mergeItems(&Type::rules, declaration.rules, declaration, "rule ", rulePrefix,
                            finding::duplicateRule, mergeRule);
    return type;
}

template <class Item, class Merge>
std::vector<Item> TypeResolver::mergeItems(std::vector<Item> Type::* list,
                                           const std::vector<Item>& own,
                                           const TypeDeclaration& declaration, const char* what,
                                           std::string (*prefix)(std::string_view),
                                           const char* duplicate, Merge merge) {
    const auto stating = ownItems(own, declaration.name, what, duplicate, report_);
    if (tooLarge_) return {};
    std::map<std::string, std::vector<FromParent<Item>>> inherited;
    for (const std::string& parent : graph_.parents(declaration.name)) {
        for (const Item& each : types_.find(parent)->second.*list) {
            inherited[each.name].push_back({&each, parent});
        }
    }
    for (const auto& [name, item] : stating) inherited[name];
    TypeContext type{
        declaration.name, declaration.place, report_,
        [this](std::string_view each, std::string_view base) { return graph_.isA(each, base); }};
    std::vector<Item> result;
    for (const auto& [name, parents] : inherited) {
        const auto found = stating.find(name);
        const Item* item = found == stating.end() ? nullptr : found->second;
        if (!affordable(declaration, item ? costOf(*item) : costOf(*parents.front().item))) break;
        if (result.size() == bounds::itemsPerType) {
            report_.error(declaration.name, finding::modelSize, declaration.place,
                          "has more than 4096 items of one kind", "divide the type");
            break;
        }
        const ItemContext context{type, what + inQuotes(name),
                                  item ? item->place : declaration.place};
        result.push_back(merge(parents, item, Stated{declaration.stated, prefix(name)}, context));
    }
    return result;
}

bool TypeResolver::affordable(const TypeDeclaration& declaration, std::size_t cost) {
    cost_ += cost;
    if (cost_ <= bounds::modelCost) return true;
    if (!std::exchange(tooLarge_, true)) {
        report_.error(declaration.name, finding::modelSize, declaration.place,
                      "the types have too many items together, those inherited included",
                      "divide the model, or shorten arrays");
    }
    return false;
}

void TypeResolver::inheritRole(Type& type, const TypeDeclaration& declaration, Said& said) {
    std::string from;
    for (const std::string& parent : type.parents) {
        if (!said_[parent].role) continue;
        const Role role = types_.find(parent)->second.role;
        if (!said.role) {
            type.role = role;
            said.role = true;
            from = parent;
            continue;
        }
        const Role before = type.role;
        if (joinRoles(type.role, role)) continue;
        report_.error(type.name, finding::roleConflict, declaration.place,
                      std::string{"is "} + name(before) + " by " + inQuotes(from) + " and " +
                          name(role) + " by " + inQuotes(parent),
                      "no type can be both: remove one of the parents");
    }
}

void TypeResolver::resolveRole(Type& type, const TypeDeclaration& declaration) {
    Said& said = said_[type.name];
    inheritRole(type, declaration, said);
    if (!declaration.role) return;
    Role joined = type.role;
    const bool narrows = joinRoles(joined, *declaration.role) && joined == *declaration.role;
    if (said.role && !narrows) {
        report_.error(type.name, finding::roleChanged, declaration.place,
                      std::string{"changes the inherited role from "} + name(type.role) + " to " +
                          name(*declaration.role),
                      type.role == Role::Descriptive
                          ? "write observation or modification, or leave role out"
                          : "leave role out, or extend another type");
    } else {
        type.role = *declaration.role;
    }
    said.role = true;
}

void TypeResolver::inheritFlags(Type& type) {
    const Type plain;
    Said& said = said_[type.name];
    for (const std::string& name : type.parents) {
        const Type& parent = types_.find(name)->second;
        if (said_[name].writers) {
            type.manyWriters = parent.manyWriters && (type.manyWriters || !said.writers);
            said.writers = true;
        }
        type.measures = type.measures || parent.measures;
        type.onLeaseLost = std::max(type.onLeaseLost, parent.onLeaseLost);
        if (parent.transitionTimeout != plain.transitionTimeout) {
            type.transitionTimeout =
                type.transitionTimeout == plain.transitionTimeout
                    ? parent.transitionTimeout
                    : std::min(type.transitionTimeout, parent.transitionTimeout);
        }
        if (type.icon.empty()) type.icon = parent.icon;
    }
}

void TypeResolver::resolveFlags(Type& type, const TypeDeclaration& declaration) {
    inheritFlags(type);
    Said& said = said_[type.name];
    const bool isWhole = declaration.stated.contains(wholeType);
    if (isWhole) {
        const Type plain;
        type.measures = plain.measures;
        type.onLeaseLost = plain.onLeaseLost;
        type.transitionTimeout = plain.transitionTimeout;
    }
    if (declaration.manyWriters) {
        if (said.writers && !type.manyWriters && *declaration.manyWriters) {
            report_.error(type.name, finding::writersChanged, declaration.place,
                          "allows many writers, inherited is one", "leave writers out");
        } else {
            type.manyWriters = *declaration.manyWriters;
        }
        said.writers = true;
    } else if (isWhole) {
        type.manyWriters = false;
    }
    if (declaration.measures) type.measures = *declaration.measures;
    if (declaration.onLeaseLost) type.onLeaseLost = *declaration.onLeaseLost;
    if (!declaration.icon.empty()) type.icon = declaration.icon;
    type.unknown = declaration.unknown;
    if (declaration.transitionTimeout) {
        const double timeout = *declaration.transitionTimeout;
        if (std::isfinite(timeout) && timeout > 0) {
            type.transitionTimeout = timeout;
        } else {
            report_.error(type.name, finding::transitionTimeout, declaration.place,
                          "has transitionTimeout=" + inQuotes(toText(timeout)),
                          "write a number of seconds above 0");
        }
    }
    if (type.description.size() > bounds::textLength) {
        report_.error(type.name, finding::textLength, declaration.place,
                      "has a description of more than 4096 octets", "shorten it");
    }
    for (const std::string Type::* text :
         {&Type::version, &Type::since, &Type::replaces, &Type::icon}) {
        if ((type.*text).size() <= bounds::sentText) continue;
        report_.error(type.name, finding::textLength, declaration.place,
                      "has an attribute of more than 65536 octets: other agents do not get it",
                      "shorten it");
    }
}

}  // namespace cortex
