// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"
#include "model/validation_checks.hpp"

#include <algorithm>

namespace cortex {
namespace {

constexpr std::uint32_t mostCreated = 1024;  // positions looked at for a reason

// Simplexes that stand where related ones would be created, but are of another type.
bool checkTaken(const Checked& checked, const Simplex& owner, const Rule& rule) {
    bool found = false;
    for (std::uint32_t n = 1; n <= std::min(rule.min, mostCreated); ++n) {
        const Simplex* taken = checked.tree.find(createdPath(owner, rule, n));
        const Type* type = createdType(checked.tree.types(), rule, n);
        if (taken == nullptr || type == nullptr || taken->type().isA(type->name)) continue;
        found = true;
        checked.report.error(taken->path(), finding::createdPath, taken->place(),
                             ruleText(owner, rule) + " of " + owner.path() + " creates " +
                                 type->name + " here; this is a " + taken->type().name,
                             "write type=\"" + type->name + "\", or give it another path");
    }
    return found;
}

// Why a rule with `create` was not filled; "" where it was not tried or has no reason of its own.
std::string whyNotCreated(const Checked& checked, const Simplex& owner, const Rule& rule) {
    if (rule.create.empty()) return "";
    if (checked.tree.simplexes().size() >= maxSimplexes) {
        return "; no more is created: the system has " + std::to_string(maxSimplexes) +
               " simplexes";
    }
    const std::string path = createdPath(owner, rule, rule.min);
    const std::string wrong = SimplexTree::pathError(path);
    return wrong.empty() ? "" : "; " + path + " cannot be created: " + wrong;
}

std::string freePath(const SimplexTree& tree, std::string path) {
    if (tree.find(path) == nullptr) return path;
    for (int n = 2;; ++n) {
        const std::string next = path + "-" + std::to_string(n);
        if (tree.find(next) == nullptr) return next;
    }
}

// Another rule with relationships that could refine this one, so that they count for it as well.
std::string refineInstead(const Checked& checked, const Simplex& owner, const Rule& rule) {
    const TypeModel& types = checked.tree.types();
    for (const Rule& other : owner.type().rules) {
        const Type* type = types.find(other.definedBy);
        const auto inherits = [&](const std::string& parent) {
            const Type* found = types.find(parent);
            return found != nullptr && found->findRule(rule.name) != nullptr;
        };
        const bool fits = other.name != rule.name && other.direction == rule.direction &&
                          other.refines.empty() && other.min <= rule.max &&
                          types.isA(other.target, rule.target);
        if (!fits || type == nullptr || std::ranges::none_of(type->parents, inherits)) continue;
        if (relationsFor(owner, other).empty()) continue;
        const std::string place = other.place.text();
        return "write refines=\"" + rule.name + "\" for rule '" + other.name + "'" +
               (place.empty() ? "" : " (" + place + ")") + ", or ";
    }
    return "";
}

std::string relateMissing(const Checked& checked, const Simplex& owner, const Rule& rule,
                          std::size_t missing) {
    const auto paths = fitting(checked, owner, rule);
    const std::string one = missing == 1 ? "one" : std::to_string(missing);
    std::string text = "relate " + one + " with";
    for (std::size_t n = 0; n < std::min<std::size_t>({missing, paths.size(), 8}); ++n) {
        text += " " + relateText(rule.name, paths[n]);
    }
    if (!paths.empty()) return text;
    const auto types = concreteTypes(checked.tree.types(), rule.target);
    if (types.empty()) {
        return "add a type that extends " + rule.target + ", and relate one of it with " +
               relateText(rule.name, "…");
    }
    const std::string path = freePath(checked.tree, owner.path() + "/" + rule.name);
    return "add <simplex path=\"" + path + "\" type=\"" + types.front() + "\"/> and " + text + " " +
           relateText(rule.name, path);
}

// How many simplexes a rule that refines this one lacks: to relate them helps both.
std::size_t lackedByRefining(const Simplex& owner, const Rule& rule) {
    std::size_t lacked = 0;
    for (const Rule& other : owner.type().rules) {
        if (other.name == rule.name || !countsFor(owner.type(), other.name, rule.name)) continue;
        const std::size_t count = relationsFor(owner, other).size();
        if (count < other.min) lacked = std::max(lacked, other.min - count);
    }
    return lacked;
}

// `misspelt`: relations whose unknown rule is taken to mean this one, a finding of their own.
void checkMinimum(const Checked& checked, const Simplex& owner, const Rule& rule, std::size_t count,
                  std::size_t misspelt) {
    if (count + misspelt >= rule.min) return;
    if (count + misspelt + lackedByRefining(owner, rule) >= rule.min) return;
    if (checkTaken(checked, owner, rule)) return;
    const std::string atLeast = rule.min == rule.max ? "" : "at least ";
    checked.report.error(owner.path(), finding::belowMin, placeFor(owner, rule),
                         ruleText(owner, rule) + " needs " + atLeast + std::to_string(rule.min) +
                             " " + rule.target + ", has " + std::to_string(count) +
                             whyNotCreated(checked, owner, rule),
                         refineInstead(checked, owner, rule) +
                             relateMissing(checked, owner, rule, rule.min - count));
}

void checkMaximum(const Checked& checked, const Simplex& owner, const Rule& rule,
                  const std::vector<const Simplex::Relation*>& counted) {
    for (std::size_t n = rule.max; n < counted.size(); ++n) {
        const auto& relation = *counted[n];
        checked.report.error(owner.path(), finding::aboveMax, relation.place,
                             ruleText(owner, rule) + " takes " + std::to_string(rule.max) + " " +
                                 rule.target + ", has " + std::to_string(counted.size()),
                             "remove this <relate>: " + relateText(relation.rule, relation.target));
    }
}

// As relateMissing(), or from another agent, as an input may.
std::string relateSame(const Checked& checked, const Simplex& owner, const Rule& rule,
                       std::size_t missing) {
    std::string text = relateMissing(checked, owner, rule, missing);
    if (rule.direction == Direction::Output) return text;
    return text + "; if another agent has it, " + relateText(rule.name, "…", "remote=\"true\"");
}

// Which of the two are to be added or removed, only their owner knows: the remedy fills up.
void checkSame(const Checked& checked, const Simplex& owner, const Rule& rule, std::size_t count) {
    const Rule* other = owner.type().findRule(rule.sameCount);
    if (other == nullptr || (count == 0 && rule.min == 0)) return;
    const std::size_t wanted = relationsFor(owner, *other).size();
    // Too few or too many of one of them by itself is a finding already.
    if (count == wanted || count < rule.min || wanted < other->min) return;
    const bool fewer = count < wanted;
    checked.report.error(owner.path(), finding::countUnequal, placeFor(owner, rule),
                         ruleText(owner, rule) + " has " + std::to_string(count) + ", rule '" +
                             other->name + "' has " + std::to_string(wanted) +
                             ": there must be one for each, in the same order",
                         fewer ? relateSame(checked, owner, rule, wanted - count)
                               : relateSame(checked, owner, *other, count - wanted));
}

}  // namespace

void checkCounts(const Checked& checked, const Simplex& owner) {
    const Type& type = owner.type();
    std::vector<std::string> meant;
    for (const auto& relation : owner.relations()) {
        if (type.findRule(relation.rule) != nullptr) continue;
        meant.push_back(meantRule(checked, owner, relation));
    }
    for (const Rule& rule : type.rules) {
        const auto counted = relationsFor(owner, rule);
        const auto misspelt = std::ranges::count_if(
            meant, [&](const std::string& each) { return countsFor(type, each, rule.name); });
        checkMinimum(checked, owner, rule, counted.size(), static_cast<std::size_t>(misspelt));
        checkMaximum(checked, owner, rule, counted);
        if (misspelt == 0) checkSame(checked, owner, rule, counted.size());
    }
}

}  // namespace cortex
