// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "types/type_attributes.hpp"
#include "types/type_merge.hpp"

#include <algorithm>
#include <cmath>

namespace cortex {

namespace {

std::string countsText(const Rule& rule) {
    return countText(rule.min) + " to " + countText(rule.max);
}

// An attribute without order: two parents that state different ones leave it to the child.
template <class Member>
void agree(Rule& rule, const FromParent<Rule>& second, const std::string& first, Member member,
           const char* attribute, const Stated& stated, const ItemContext& context) {
    const std::string& other = (*second.item).*member;
    if ((rule.*member).empty()) {
        rule.*member = other;
    } else if (!other.empty() && rule.*member != other && !stated(attribute, false)) {
        context.restate(attribute, rule.*member, other, first, second.parent);
    }
}

void intersect(Rule& rule, const FromParent<Rule>& second, const std::string& first,
               const Rule* own, const Stated& stated, const ItemContext& context) {
    const Rule& other = *second.item;
    if (rule.direction != other.direction) {
        context.exclude("direction", name(rule.direction), name(other.direction), first,
                        second.parent);
        return;
    }
    const auto& isA = context.type.isA;
    if (isA(other.target, rule.target)) {
        rule.target = other.target;
    } else if (!isA(rule.target, other.target)) {
        const bool settled = own && !own->target.empty() && isA(own->target, rule.target) &&
                             isA(own->target, other.target);
        if (settled) {
            rule.target = own->target;
        } else {
            context.exclude("target", rule.target, other.target, first, second.parent);
        }
    }
    const std::string before = countsText(rule);
    rule.min = std::max(rule.min, other.min);
    rule.max = std::min(rule.max, other.max);
    if (rule.min > rule.max) {
        context.exclude("count", before, countsText(other), first, second.parent);
        rule.max = rule.min;
    }
    if (rule.create.empty()) {
        rule.create = other.create;
    } else if (!other.create.empty() && rule.create != other.create && !stated("create", false)) {
        context.restate("create", joined(rule.create), joined(other.create), first, second.parent);
    }
    rule.delayed = rule.delayed || other.delayed;
    rule.maxAge = std::min(rule.maxAge, other.maxAge);
    if (rule.onLoss != other.onLoss && !stated("onLoss", false)) {
        context.restate("onLoss", name(rule.onLoss), name(other.onLoss), first, second.parent);
    }
    agree(rule, second, first, &Rule::refines, "refines", stated, context);
    agree(rule, second, first, &Rule::counterpart, "counterpart", stated, context);
    agree(rule, second, first, &Rule::sameCount, "sameCount", stated, context);
    if (rule.description.empty()) rule.description = other.description;
}

void narrowCounts(Rule& rule, const Rule& own, const Stated& stated, const ItemContext& context) {
    const auto widened = [&](const char* attribute, std::uint32_t inherited, std::uint32_t now) {
        context.error(finding::countWidened,
                      std::string{"widens the inherited "} + attribute + " from " +
                          countText(inherited) + " to " + countText(now),
                      std::string{"write "} + attribute + "=\"" + countText(inherited) +
                          "\" or narrower, or leave it out");
    };
    if (stated("min", own.min != 0)) {
        if (own.min < rule.min) widened("min", rule.min, own.min);
        rule.min = std::max(rule.min, own.min);
    }
    if (stated("max", own.max != Rule::many)) {
        if (own.max > rule.max) widened("max", rule.max, own.max);
        rule.max = std::min(rule.max, own.max);
    }
}

// A child may add it. Where parents differ, it takes one of theirs.
void narrowSameCount(Rule& rule, const Rule& own, const std::vector<FromParent<Rule>>& parents,
                     const ItemContext& context) {
    if (own.sameCount.empty()) return;
    const auto isTheirs = [&](const FromParent<Rule>& parent) {
        return parent.item->sameCount == own.sameCount;
    };
    if (!rule.sameCount.empty() && std::ranges::none_of(parents, isTheirs)) {
        context.error(finding::sameCount,
                      "changes the inherited sameCount from " + inQuotes(rule.sameCount) + " to " +
                          inQuotes(own.sameCount),
                      "leave sameCount out");
        return;
    }
    rule.sameCount = own.sameCount;
}

void narrow(Rule& rule, const Rule& own, const Stated& stated, const ItemContext& context) {
    if (stated("direction", false) && own.direction != rule.direction) {
        context.error(finding::directionChanged,
                      std::string{"changes the inherited direction from "} + name(rule.direction) +
                          " to " + name(own.direction),
                      "leave direction out, or take another name");
    }
    if (!own.target.empty()) {
        if (context.type.isA(own.target, rule.target)) {
            rule.target = own.target;
        } else {
            context.error(finding::targetWidened,
                          "has the target " + inQuotes(own.target) +
                              ", which is no child of the inherited " + inQuotes(rule.target),
                          "write target=\"" + rule.target + "\" or a child of it, or leave it out");
        }
    }
    narrowCounts(rule, own, stated, context);
    if (!own.create.empty()) rule.create = own.create;
    if (stated("delayed", own.delayed)) {
        if (rule.delayed && !own.delayed) {
            context.error(finding::delayedLoosened, "takes back the inherited delayed=\"true\"",
                          "leave delayed out");
        }
        rule.delayed = rule.delayed || own.delayed;
    }
    if (stated("onLoss", own.onLoss != OnLoss::Propagate)) rule.onLoss = own.onLoss;
    if (stated("maxAge", own.maxAge != Rule{}.maxAge)) rule.maxAge = own.maxAge;
    if (!own.refines.empty()) rule.refines = own.refines;
    if (!own.counterpart.empty()) rule.counterpart = own.counterpart;
    if (!own.description.empty()) rule.description = own.description;
}

void checkNew(const Rule& own, const Stated& stated, const ItemContext& context) {
    if (stated.lacks("direction")) {
        context.error(finding::directionMissing, "has no direction, and no parent has this name",
                      "write direction=\"input\" or \"output\", or correct the name");
    }
    if (own.target.empty()) {
        context.error(finding::targetMissing, "has no target, and no parent has this name",
                      "write target=\"…\" with the type that related simplexes must be");
    }
}

void check(Rule& rule, const Rule* own, const Stated& stated, const ItemContext& context) {
    if (rule.min > rule.max || rule.max == 0) {
        context.error(finding::countEmpty, "needs " + countsText(rule) + " relationships",
                      "write a min that is not above max, and a max of 1 or more");
        rule.max = std::max(rule.min, 1U);
    }
    if (!own) return;
    if (joined(own->create).size() > bounds::sentText) {
        context.error(finding::textLength,
                      "creates so many that their types take more than 65536 octets as text: other "
                      "agents do not get it",
                      "create fewer, and write the others as simplexes of the system");
    }
    const bool lossWritten = stated.isWritten("onLoss", own->onLoss != OnLoss::Propagate) ||
                             stated.isWritten("maxAge", false);
    if (rule.direction == Direction::Output && lossWritten) {
        context.error(finding::onLossDirection, "is an output and has onLoss or maxAge",
                      "state them on the input rule of who reads");
    }
    if (!(std::isfinite(rule.maxAge) && rule.maxAge > 0)) {
        context.error(finding::maxAge, "has maxAge=" + inQuotes(toText(rule.maxAge)),
                      "write a number of seconds above 0");
        rule.maxAge = Rule{}.maxAge;
    }
}

}  // namespace

Rule mergeRule(const std::vector<FromParent<Rule>>& parents, const Rule* own, const Stated& stated,
               const ItemContext& context) {
    Rule rule = parents.empty() ? *own : *parents.front().item;
    for (std::size_t i = 1; i < parents.size(); ++i) {
        intersect(rule, parents[i], parents.front().parent, own, stated, context);
    }
    if (own) {
        rule.definedBy = context.type.type;
        rule.place = own->place;
        rule.unknown = own->unknown;
        if (parents.empty()) {
            checkNew(*own, stated, context);
        } else {
            narrow(rule, *own, stated, context);
            narrowSameCount(rule, *own, parents, context);
        }
    }
    if (own || parents.size() > 1) check(rule, own, stated, context);
    keepOrigin(rule, parents, stated);
    return rule;
}

}  // namespace cortex
