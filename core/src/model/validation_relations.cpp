// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/validation_checks.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

namespace cortex {
namespace {

using Relation = Simplex::Relation;

std::string article(const std::string& noun) {
    const bool vowel = std::string_view{"AEIOUaeiou"}.find(noun.front()) != std::string::npos;
    return (vowel ? "an " : "a ") + noun;
}

// How many levels two paths have in common.
std::size_t commonLevels(const std::string& left, const std::string& right) {
    const auto [end, other] = std::ranges::mismatch(left, right);
    return static_cast<std::size_t>(std::count(left.begin(), end, '/'));
}

std::string writeOneOf(const Relation& relation, const std::string& rule,
                       const std::vector<std::string>& paths) {
    std::string text = "write " + relateText(relation, rule, paths.front());
    if (paths.size() > 1) text += "; there are " + listText(paths);
    return text;
}

void checkUnknownRule(const Checked& checked, const Simplex& owner, const Relation& relation) {
    const auto names = namesOf(owner.type().rules);
    const std::string nearest = meantRule(checked, owner, relation);
    std::string remedy = "remove it: type " + owner.type().name + " has no rules";
    if (!names.empty()) remedy = "rules of " + owner.type().name + ": " + listText(names);
    if (!nearest.empty())
        remedy = "write " + relateText(relation, nearest, relation.target) + "; " + remedy;
    checked.report.error(owner.path(), finding::unknownRule, relation.place,
                         "type " + owner.type().name + " has no rule '" + relation.rule + "'",
                         remedy);
}

void checkUnknownTarget(const Checked& checked, const Simplex& owner, const Rule& rule,
                        const Relation& relation) {
    if (checked.declared.contains(relation.target)) return;  // refused, with a finding of its own
    auto paths = fitting(checked, owner, rule);
    const std::string nearest = nearestName(relation.target, paths);
    if (!nearest.empty()) paths.insert(paths.begin(), nearest);
    std::string remedy = paths.empty() ? "add a simplex with this path"
                                       : "write " + relateText(relation, rule.name, paths.front());
    if (rule.direction == Direction::Input) {
        Relation elsewhere = relation;
        elsewhere.remote = true;
        const std::string remote = relateText(elsewhere, rule.name, relation.target);
        remedy = nearest.empty() ? "if another agent has it, write " + remote +
                                       "; if this one should, " + remedy
                                 : remedy + "; if another agent has it, " + remote;
    }
    checked.report.error(owner.path(), finding::unknownPath, relation.place,
                         ruleText(owner, rule) + ": there is no simplex '" + relation.target + "'",
                         remedy);
}

void checkTargetType(const Checked& checked, const Simplex& owner, const Rule& rule,
                     const Relation& relation, const Simplex& target) {
    if (target.type().isA(rule.target)) return;
    const auto paths = fitting(checked, owner, rule);
    checked.report.error(owner.path(), finding::targetType, relation.place,
                         ruleText(owner, rule) + " takes " + article(rule.target) + "; " +
                             target.path() + " is " + article(target.type().name),
                         paths.empty() ? "add a simplex of type " + rule.target + " and relate it"
                                       : writeOneOf(relation, rule.name, paths));
}

void checkRemote(const Checked& checked, const Simplex& owner, const Rule& rule,
                 const Relation& relation) {
    const std::string text = ruleText(owner, rule);
    if (rule.direction == Direction::Output) {
        checked.report.error(owner.path(), finding::remoteOutput, relation.place,
                             text + " is an output; data of another agent is only read",
                             "give " + owner.type().name +
                                 " a rule with direction=\"input\" and target=\"" + rule.target +
                                 "\", relate it under that one, and send it "
                                 "commands from there");
    } else if (const auto wrong = SimplexTree::pathError(relation.target); !wrong.empty()) {
        checked.report.error(owner.path(), finding::malformedPath, relation.place,
                             text + ": path '" + relation.target + "': " + wrong,
                             "write the path that the simplex has in its own agent");
    }
    if (relation.type.empty() || checked.tree.types().isA(relation.type, rule.target)) return;
    checked.report.error(
        owner.path(), finding::targetType, relation.place,
        text + " takes " + article(rule.target) + "; '" + relation.type + "' is none",
        "write the type that it has there, or leave type=\"…\" out");
}

void reportTwice(const Checked& checked, const Simplex& owner, const Rule& rule,
                 const Relation& relation) {
    const auto count = std::ranges::count(owner.relations(), rule.name, &Relation::rule);
    const auto paths = fitting(checked, owner, rule);
    const bool enough = count > static_cast<std::ptrdiff_t>(rule.min);
    checked.report.error(owner.path(), finding::targetTwice, relation.place,
                         ruleText(owner, rule) + " relates " + relation.target + " a second time",
                         enough || paths.empty() ? "remove this <relate>, or correct its target"
                                                 : writeOneOf(relation, rule.name, paths));
}

// What simplexes of the same type write, this one included: who read it would follow itself.
std::set<std::string_view> outputsOfPeers(const Checked& checked, const Simplex& owner) {
    std::set<std::string_view> outputs;
    for (const auto& [path, simplex] : checked.tree.simplexes()) {
        if (&simplex->type() != &owner.type()) continue;
        for (const Relation& each : simplex->relations()) {
            const Rule* rule = owner.type().findRule(each.rule);
            if (rule != nullptr && rule->direction == Direction::Output)
                outputs.insert(each.target);
        }
    }
    return outputs;
}

std::string_view parentOf(std::string_view path) { return path.substr(0, path.rfind('/')); }

// What other simplexes of the same type relate under the rule.
std::set<std::string_view> targetsOfPeers(const Checked& checked, const Simplex& owner,
                                          const Rule& rule) {
    std::set<std::string_view> targets;
    for (const auto& [path, simplex] : checked.tree.simplexes()) {
        if (&simplex->type() != &owner.type()) continue;
        for (const Relation& each : simplex->relations()) {
            if (each.rule == rule.name) targets.insert(each.target);
        }
    }
    return targets;
}

}  // namespace

std::string meantRule(const Checked& checked, const Simplex& owner, const Relation& relation) {
    const auto& rules = owner.type().rules;
    std::string nearest = nearestName(relation.rule, namesOf(rules));
    const Simplex* target = checked.tree.find(relation.target);
    if (!nearest.empty() || target == nullptr) return nearest;
    const auto taking = std::ranges::find_if(
        rules, [&](const Rule& rule) { return target->type().isA(rule.target); });
    return taking != rules.end() ? taking->name : "";
}

std::string ruleText(const Simplex& owner, const Rule& rule) {
    const std::string place = owner.place().file.empty() ? "" : rule.place.text();
    return "rule '" + rule.name + "'" + (place.empty() ? "" : " (" + place + ")");
}

Place placeFor(const Simplex& owner, const Rule& rule) {
    return owner.place().file.empty() ? rule.place : owner.place();
}

std::vector<std::string> fitting(const Checked& checked, const Simplex& owner, const Rule& rule) {
    std::vector<std::string> paths;
    if (!looksForNearest(checked.report)) return paths;
    const std::set<std::string_view> targets = targetsOfPeers(checked, owner, rule);
    std::set<std::string_view> outputs, folders;
    if (rule.direction == Direction::Input) outputs = outputsOfPeers(checked, owner);
    for (const std::string_view target : targets) folders.insert(parentOf(target));
    for (const auto& [path, simplex] : checked.tree.simplexes()) {
        const auto related = [&](const Relation& each) {
            return each.rule == rule.name && each.target == path;
        };
        const bool written = rule.direction == Direction::Output && !simplex->type().manyWriters &&
                             !checked.info(*simplex).writers.empty();
        const bool fits = simplex.get() != &owner && simplex->type().isA(rule.target) && !written &&
                          !outputs.contains(path);
        if (fits && std::ranges::none_of(owner.relations(), related)) paths.push_back(path);
    }
    const auto isWritten = [&](const std::string& path) {
        const std::uint32_t index = checked.structure.find(path);
        return rule.direction == Direction::Output && index != noSimplex &&
               !checked.structure.simplexes[index].writers.empty();
    };
    std::ranges::sort(paths, {}, [&](const std::string& path) {
        return std::tuple{isWritten(path), !folders.contains(parentOf(path)),
                          targets.contains(path),
                          -static_cast<std::ptrdiff_t>(commonLevels(owner.path(), path)), path};
    });
    return paths;
}

void checkRelations(const Checked& checked, const Simplex& owner) {
    std::set<std::pair<std::string_view, std::string_view>> related;
    for (const Relation& relation : owner.relations()) {
        const Rule* rule = owner.type().findRule(relation.rule);
        if (rule == nullptr) {
            checkUnknownRule(checked, owner, relation);
            continue;
        }
        if (!related.emplace(relation.rule, relation.target).second) {
            reportTwice(checked, owner, *rule, relation);
        }
        const Simplex* target = checked.tree.find(relation.target);
        if (target != nullptr) checkTargetType(checked, owner, *rule, relation, *target);
        if (relation.remote)
            checkRemote(checked, owner, *rule, relation);
        else if (target == nullptr)
            checkUnknownTarget(checked, owner, *rule, relation);
    }
}

}  // namespace cortex
