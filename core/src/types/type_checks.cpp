// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"
#include "cortex/core/nearest_names.hpp"

#include "base/text.hpp"
#include "types/type_attributes.hpp"
#include "types/type_resolver.hpp"
#include "types/unit.hpp"

#include <algorithm>
#include <vector>

// What can be said of a type only when all types are resolved.
namespace cortex {

namespace {

struct BuiltIn {
    std::string_view name;
    const char* use;
};
constexpr BuiltIn builtInCommands[] = {
    {"set", "settable=\"…\" lets data be set without a command of its own"},
    {"cancel", "a long command can be cancelled without a command of its own"}};

std::string nearestRule(std::string_view wrong, const Type& type) {
    std::vector<std::string> valid;
    for (const Rule& each : type.rules) valid.push_back(each.name);
    std::string near = nearestNames(wrong, valid);
    if (!near.empty()) return near;
    std::string all;
    for (const std::string& each : valid) all += (all.empty() ? "valid: " : ", ") + each;
    return all;
}

}  // namespace

void ItemContext::restate(const char* attribute, const std::string& first,
                          const std::string& second, const std::string& firstParent,
                          const std::string& secondParent) const {
    error(finding::restate,
          std::string{"has "} + attribute + "=" + inQuotes(first) + " from " +
              inQuotes(firstParent) + " and " + inQuotes(second) + " from " +
              inQuotes(secondParent),
          "restate " + std::string{attribute} + "=\"…\" in " + inQuotes(type.type));
}

void ItemContext::exclude(const std::string& attribute, const std::string& first,
                          const std::string& second, const std::string& firstParent,
                          const std::string& secondParent) const {
    error(finding::intersectionEmpty,
          "has " + attribute + " " + inQuotes(first) + " from " + inQuotes(firstParent) + " and " +
              inQuotes(second) + " from " + inQuotes(secondParent) + ", which exclude each other",
          "rename one of the two, or do not extend both");
}

// Only what this type says or joins itself: its parents' own mistakes are found with them.
void TypeResolver::checkRules(const Type& type) {
    const auto inherited = [&](const Rule& rule) {
        return std::ranges::any_of(type.parents, [&](const std::string& parent) {
            const Rule* same = types_.find(parent)->second.findRule(rule.name);
            return same && same->target == rule.target && same->create == rule.create &&
                   same->refines == rule.refines && same->counterpart == rule.counterpart &&
                   same->sameCount == rule.sameCount;
        });
    };
    for (const Rule& rule : type.rules) {
        if (rule.definedBy != type.name && inherited(rule)) continue;
        if (!rule.target.empty() && !graph_.known(rule.target) && rule.definedBy == type.name) {
            const std::string near = graph_.nearest(rule.target);
            report_.error(type.name, finding::unknownTarget, rule.place,
                          "rule " + inQuotes(rule.name) + " has the target " +
                              inQuotes(rule.target) + ", which is no known type",
                          near.empty() ? "include the ontology that declares it" : near);
        }
        checkCreate(type, rule);
        checkRefines(type, rule);
        checkCounterpart(type, rule);
        checkSameCount(type, rule);
    }
}

void TypeResolver::checkCreate(const Type& type, const Rule& rule) {
    for (const std::string& created : rule.create) {
        const std::string what = "rule " + inQuotes(rule.name) + " creates " + inQuotes(created);
        if (!graph_.known(created)) {
            if (rule.definedBy != type.name) continue;
            const std::string near = graph_.nearest(created);
            report_.error(type.name, finding::unknownCreate, rule.place,
                          what + ", which is no known type",
                          near.empty() ? "include the ontology that declares it" : near);
            continue;
        }
        if (!graph_.isA(created, rule.target)) {
            report_.error(type.name, finding::createTarget, rule.place,
                          what + ", which is no " + inQuotes(rule.target),
                          "restate create with " + inQuotes(rule.target) + " or children of it");
        }
        if (types_.find(created)->second.isAbstract) {
            report_.error(type.name, finding::createAbstract, rule.place,
                          what + ", which is abstract", "name a child of it that is not");
        }
    }
}

void TypeResolver::checkRefines(const Type& type, const Rule& rule) {
    if (rule.refines.empty() || graph_.incomplete(type.name)) return;
    const auto error = [&](const std::string& message, std::string remedy) {
        report_.error(
            type.name, finding::refines, rule.place,
            "rule " + inQuotes(rule.name) + " refines " + inQuotes(rule.refines) + message,
            std::move(remedy));
    };
    const Rule* general = type.findRule(rule.refines);
    const auto has = [&](const std::string& parent) {
        return types_.find(parent)->second.findRule(rule.refines) != nullptr;
    };
    if (!general || !std::ranges::any_of(type.parents, has)) {
        error(", which is no inherited rule", nearestRule(rule.refines, type));
        return;
    }
    std::set<std::string_view> seen;
    for (const Rule* each = &rule; each; each = type.findRule(each->refines)) {
        if (each->refines.empty()) break;
        if (seen.insert(each->name).second) continue;
        error(", which leads back to itself", "remove refines from one of them");
        return;
    }
    if (general->direction != rule.direction) {
        error(std::string{", which is an "} + name(general->direction),
              "refine a rule of its direction");
    }
    if (general->delayed && !rule.delayed) {
        error(", which is delayed", "write delayed=\"true\" for it as well");
    }
    if (!graph_.isA(rule.target, general->target)) {
        error(", whose target " + inQuotes(general->target) + " is not that of " +
                  inQuotes(rule.target),
              "write target=\"" + general->target + "\" or a child of it");
    }
    if (rule.min > general->max) {
        error(" and needs more relationships than that allows",
              "write a min of at most " + std::to_string(general->max));
    }
}

void TypeResolver::checkCounterpart(const Type& type, const Rule& rule) {
    if (rule.counterpart.empty() || graph_.incomplete(type.name)) return;
    const Rule* observed = type.findRule(rule.counterpart);
    if (observed && observed->direction == Direction::Input &&
        rule.direction == Direction::Output) {
        return;
    }
    const bool input = rule.direction == Direction::Input;
    report_.error(type.name, finding::counterpart, rule.place,
                  "rule " + inQuotes(rule.name) + " has the counterpart " +
                      inQuotes(rule.counterpart) +
                      (input       ? ", but is no output"
                       : !observed ? ", which is no rule of this type"
                                   : ", which is no input"),
                  input       ? "remove counterpart: it belongs to the output that demands"
                  : !observed ? nearestRule(rule.counterpart, type)
                              : "name the input rule that observes what this output demands");
}

void TypeResolver::checkSameCount(const Type& type, const Rule& rule) {
    if (rule.sameCount.empty() || graph_.incomplete(type.name)) return;
    const std::string what =
        "rule " + inQuotes(rule.name) + " has sameCount=" + inQuotes(rule.sameCount);
    const Rule* other = type.findRule(rule.sameCount);
    if (other == nullptr || other == &rule) {
        report_.error(type.name, finding::sameCount, rule.place,
                      what + (other ? ", which is itself" : ", which is no rule of this type"),
                      other ? "name the rule that it goes by" : nearestRule(rule.sameCount, type));
        return;
    }
    if (rule.min <= other->max && other->min <= rule.max) return;
    report_.error(type.name, finding::sameCount, rule.place,
                  what + ", but takes " + countText(rule.min) + " to " + countText(rule.max) +
                      " relationships and that one " + countText(other->min) + " to " +
                      countText(other->max),
                  "give both rules a number that both allow");
}

// An open unit is for types that nothing is an instance of; parameters have no children to fix it.
void TypeResolver::checkUnits(const Type& type) {
    const auto open = [&](const DataItem& item, const std::string& what, const char* remedy) {
        if (item.unit != openUnit) return;
        const bool own = item.definedBy == type.name && !item.place.file.empty();
        report_.error(type.name, finding::unitOpen, own ? item.place : type.place,
                      what + " " + inQuotes(item.name) + " has an open unit", remedy);
    };
    if (!type.isAbstract) {
        for (const DataItem& item : type.data) {
            open(item, "data", "state its unit in this type, or write abstract=\"true\"");
        }
    }
    for (const Command& command : type.commands) {
        if (command.definedBy != type.name) continue;
        for (const auto* list : {&command.request, &command.response}) {
            for (const DataItem& parameter : *list) {
                open(parameter, "command " + inQuotes(command.name) + ": parameter",
                     "state its unit, or leave it out");
            }
        }
    }
}

void TypeResolver::checkBehaviour(const Type& type) {
    const bool knowsAll = !graph_.incomplete(type.name);
    for (const Command& command : type.commands) {
        if (command.definedBy != type.name) continue;
        const std::string what = "command " + inQuotes(command.name);
        if (!type.active() && knowsAll) {
            report_.error(type.name, finding::commandRole, command.place,
                          what + " is on a type that is not active",
                          "write role=\"active\" or extend an active type, or remove the command");
        }
        if (command.isLong && !graph_.isA(type.name, "Activity") && knowsAll) {
            report_.error(type.name, finding::longActivity, command.place,
                          what + " is long, but the type is no 'Activity'",
                          "include base.xml and extend Activity too, or remove long");
        }
        if (command.isLong && !graph_.known("Activity")) {
            report_.error(type.name, finding::longActivity, command.place,
                          what + " is long, but there is no type 'Activity'",
                          "include base.xml and extend Activity");
        }
        for (const auto& [name, use] : builtInCommands) {
            if (command.name != name) continue;
            report_.error(type.name, finding::reservedName, command.place,
                          what + " has the name of a built-in command",
                          std::string{"take another name; "} + use);
        }
    }
    for (const DataItem& item : type.data) {
        const bool demand = type.role == Role::Modification || type.role == Role::Descriptive;
        const bool free = item.atRest == AtRest::Writer && item.definedBy == type.name;
        if (!free || (demand && item.safe.kind != Safe::Kind::None)) continue;
        report_.error(type.name, finding::atRest, item.place,
                      "data " + inQuotes(item.name) + " has atRest=\"writer\", but " +
                          (demand ? "no safe value" : "the type is no modification"),
                      demand ? "write a safe value, or remove atRest" : "remove atRest");
    }
    if (type.role != Role::Modification) return;
    for (const DataItem& item : type.data) {
        if (item.safe.kind != Safe::Kind::None || item.constant) continue;
        const bool inherited = std::ranges::any_of(type.parents, [&](const std::string& parent) {
            const Type& each = types_.find(parent)->second;
            return each.role == Role::Modification && each.findData(item.name) != nullptr;
        });
        if (inherited) continue;
        report_.error(
            type.name, finding::safeMissing, item.definedBy == type.name ? item.place : type.place,
            "data " + inQuotes(item.name) + " has no safe value, and the type is a modification",
            "write safe=\"hold\", \"observed\", \"stop\" or a value");
    }
}

}  // namespace cortex
