// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"
#include "model/validation_checks.hpp"
#include "types/unit.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

namespace cortex {
namespace {

// A related simplex, and how it is related.
struct Related {
    const Simplex::Relation* relation;
    const Rule* rule;
    const Type* type;
};

struct DifferentUnits {
    const DataItem *first, *second;
};

bool isStated(const DataItem& item) { return !item.unit.empty() && item.unit != openUnit; }

class Units {
public:
    Units(const Checked& checked, const Simplex& owner) : checked_{checked}, owner_{owner} {
        for (const ResolvedRelation& each : resolveRelations(checked.tree, owner)) {
            const Type* type = each.target != nullptr ? &each.target->type()
                                                      : each.wantedType(checked.tree.types());
            if (type != nullptr) related_.push_back({each.relation, each.rule, type});
        }
    }

    void checkPairs(const Rule& rule, const std::string& otherRule) const;
    void checkFlow() const;

private:
    std::vector<Related> under(std::string_view rule) const;
    static std::vector<DifferentUnits> differences(const Related& first, const Related& second);
    std::string text(const Related& related, const DataItem& item) const {
        return related.relation->target + " (rule '" + related.relation->rule + "') has '" +
               item.name + "' in " + item.unit;
    }

    const Checked& checked_;
    const Simplex& owner_;
    std::vector<Related> related_;
};

std::vector<Related> Units::under(std::string_view rule) const {
    std::vector<Related> found;
    for (const Related& each : related_) {
        if (countsFor(owner_.type(), each.rule->name, rule)) found.push_back(each);
    }
    return found;
}

// Items of one name that both state a unit, but not the same one. What another agent has may be
// known by an abstract type, which leaves it open.
std::vector<DifferentUnits> Units::differences(const Related& first, const Related& second) {
    std::vector<DifferentUnits> found;
    if (first.type == second.type) return found;
    for (const DataItem& item : first.type->data) {
        const DataItem* other = second.type->findData(item.name);
        if (other == nullptr || !isStated(item) || !isStated(*other)) continue;
        if (item.unit != other->unit) found.push_back({&item, other});
    }
    return found;
}

// The n-th of the one belongs to the n-th of the other, or to its only one.
void Units::checkPairs(const Rule& rule, const std::string& otherRule) const {
    const std::vector<Related> own = under(rule.name), others = under(otherRule);
    for (std::size_t n = 0; n < own.size(); ++n) {
        const std::size_t place = others.size() == 1 ? 0 : n;
        if (place >= others.size()) return;  // of unequal numbers others tell
        const std::vector<DifferentUnits> found = differences(own[n], others[place]);
        if (found.empty()) continue;
        const auto& [item, other] = found.front();
        std::string more;
        for (std::size_t i = 1; i < found.size(); ++i)
            more += (i == 1 ? "; their units of '" : "', '") + found[i].first->name;
        if (!more.empty()) more += "' differ, too";
        checked_.report.error(
            owner_.path(), finding::pairUnit, own[n].relation->place,
            text(own[n], *item) + ", its pair " + text(others[place], *other) + more,
            "relate both in the same order, or give their types one unit");
    }
}

bool sameDimension(const DataItem& first, const DataItem& second) {
    std::string why;
    const auto left = parseUnit(first.unit, why), right = parseUnit(second.unit, why);
    return left && right && left->dimension == right->dimension;
}

// What one simplex reads and writes under one name is one quantity: metres here and millimetres
// there is likely a slip.
void Units::checkFlow() const {
    std::set<std::string_view> told;
    for (const Related& input : related_) {
        if (input.rule->direction != Direction::Input) continue;
        for (const Related& output : related_) {
            if (output.rule->direction != Direction::Output) continue;
            for (const auto& [item, other] : differences(input, output)) {
                if (!sameDimension(*item, *other) || !told.insert(item->name).second) continue;
                checked_.report.warning(
                    owner_.path(), finding::flowUnit, output.relation->place,
                    "it reads and writes '" + item->name +
                        "' in different units: " + text(input, *item) + ", " + text(output, *other),
                    "give both types one unit; if it converts, give the items two names");
            }
        }
    }
}

constexpr double mostTurned = 100;  // rad: some sixteen turns, more than nearly all axes have
constexpr double degree = 3.14159265358979323846 / 180;

}  // namespace

void checkAngles(const Checked& checked) {
    std::set<const Type*> types;
    for (const auto& [path, simplex] : checked.tree.simplexes()) {
        const DataItem* position = simplex->type().findData("position");
        if (position == nullptr || position->unit != "rad") continue;
        double most = 0;
        for (const auto& bound : {position->min, position->max}) {
            const double* number = bound ? std::get_if<double>(&*bound) : nullptr;
            if (number != nullptr && std::isfinite(*number))
                most = std::max(most, std::abs(*number));
        }
        if (most <= mostTurned || !types.insert(&simplex->type()).second) continue;
        checked.report.warning(path, finding::angleRange, position->place,
                               "position of type " + simplex->type().name + " reaches to " +
                                   toText(most) + " rad, which is " +
                                   toText(std::round(most / degree / 360)) +
                                   " turns: are these degrees?",
                               "write " + toText(std::round(most * degree * 1e4) / 1e4) + " for " +
                                   toText(most) + " degrees");
    }
}

void checkUnits(const Checked& checked, const Simplex& owner) {
    const Units units{checked, owner};
    for (const Rule& rule : owner.type().rules) {
        std::set<std::string> paired{rule.counterpart, rule.sameCount};
        paired.erase("");
        for (const std::string& other : paired) units.checkPairs(rule, other);
    }
    if (owner.type().active()) units.checkFlow();
}

}  // namespace cortex
