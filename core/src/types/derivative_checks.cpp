// SPDX-License-Identifier: Apache-2.0
#include "types/derivative_checks.hpp"

#include "cortex/core/findings.hpp"

#include "base/text.hpp"
#include "types/item_problems.hpp"
#include "types/unit.hpp"

#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cortex {

namespace {

bool stops(const DataItem& item) { return item.safe.kind == Safe::Kind::Stop; }

// What is another item's change per second has that item's unit per second.
bool isPerSecond(const DataItem& item, const DataItem& base) {
    if (item.unit == openUnit || base.unit == openUnit) return true;
    if (item.unit.empty() || base.unit.empty()) return item.unit == base.unit;
    std::string why;
    const auto unit = parseUnit(item.unit, why), expected = parseUnit(base.unit + "/s", why);
    return unit && (!expected || unit->canonical == expected->canonical);
}

std::string ratio(const std::string& unit) {
    std::string why;
    const auto parsed = parseUnit(unit + "/s", why);
    return parsed ? parsed->canonical : unit + "/s";
}

class Derivatives {
public:
    explicit Derivatives(const Type& type)
        : type_{type}, loops_{loopsOf(type, &DataItem::derivativeOf)} {
        for (const DataItem& item : type_.data) {
            const DataItem* base = type_.findData(item.derivativeOf);
            if (!item.derivativeOf.empty() && checkShape(item, base) && checkOrder(item))
                checkLimits(item, *base);
            checkStop(item);
        }
    }
    ItemProblems& problems() { return problems_; }

private:
    void error(const DataItem& item, const char* rule, std::string message, std::string remedy) {
        problems_.push_back({&item, rule, std::move(message), std::move(remedy)});
    }
    bool checkShape(const DataItem& item, const DataItem* base);
    bool checkOrder(const DataItem& item);
    void checkLimits(const DataItem& item, const DataItem& base);
    void checkStop(const DataItem& item);
    void checkStopOfDerivative(const DataItem& item, const DataItem& base);
    std::vector<const DataItem*> derivativesOf(const DataItem& item) const;

    const Type& type_;
    std::set<const DataItem*> loops_;
    ItemProblems problems_;
};

bool Derivatives::checkShape(const DataItem& item, const DataItem* base) {
    const std::string what = "has derivativeOf=" + inQuotes(item.derivativeOf);
    if (base == nullptr) {
        error(
            item, finding::derivative, what + ", which is no item of this type",
            nearestItems(type_, item.derivativeOf, "name the item whose change per second it is"));
    } else if (item.kind != Kind::Float || base->kind != Kind::Float) {
        error(item, finding::derivative, what + ", but not both are float",
              "write kind=\"float\" for both, or remove derivativeOf");
    } else if (item.length != base->length) {
        error(item, finding::derivative,
              what + ", but " + std::to_string(item.length) + " elements for its " +
                  std::to_string(base->length),
              "give both one length");
    } else if (!isPerSecond(item, *base)) {
        error(item, finding::derivative,
              what + ", but the unit " + inQuotes(item.unit) + ", and that one has " +
                  inQuotes(base->unit),
              base->unit.empty() ? "state the unit of both, or of none"
                                 : "write unit=\"" + ratio(base->unit) + "\"");
    } else {
        return true;
    }
    return false;
}

// Nothing is, by way of others, its own derivative.
bool Derivatives::checkOrder(const DataItem& item) {
    if (!loops_.contains(&item)) return true;
    error(item, finding::derivative, "is a derivative of itself",
          "name the item whose change per second it is");
    return false;
}

// One limit that stands in two places is one number. What is not stated is not judged.
void Derivatives::checkLimits(const DataItem& item, const DataItem& base) {
    if (!base.rate || !item.max || *item.max == Number{*base.rate}) return;
    error(item, finding::limitPair,
          "has max=" + inQuotes(toText(*item.max)) + ", but " + inQuotes(base.name) +
              ", whose derivative it is, has rate=" + inQuotes(toText(*base.rate)),
          "give both one number, or state one of them only");
}

std::vector<const DataItem*> Derivatives::derivativesOf(const DataItem& item) const {
    std::vector<const DataItem*> found;
    for (const DataItem& each : type_.data) {
        if (each.derivativeOf == item.name && stops(each)) found.push_back(&each);
    }
    return found;
}

void Derivatives::checkStop(const DataItem& item) {
    if (!stops(item)) return;
    if (!item.derivativeOf.empty()) {
        const DataItem* base = type_.findData(item.derivativeOf);
        if (base != nullptr) checkStopOfDerivative(item, *base);
        return;
    }
    const std::vector<const DataItem*> derivatives = derivativesOf(item);
    if (derivatives.size() == 1) return;
    error(item, finding::stopPair,
          derivatives.empty()
              ? std::string{"is safe=\"stop\" alone: no derivative of it stops with it"}
              : "is safe=\"stop\", and so are " + inQuotes(derivatives[0]->name) + " and " +
                    inQuotes(derivatives[1]->name) + ", both derivatives of it",
          "write safe=\"stop\" for an item and for one that has derivativeOf with its name; "
          "otherwise hold, observed or a value");
}

void Derivatives::checkStopOfDerivative(const DataItem& item, const DataItem& base) {
    if (!stops(base)) {
        error(item, finding::stopPair,
              "is safe=\"stop\", but " + inQuotes(base.name) + ", whose derivative it is, is not",
              "write safe=\"stop\" for both, or another safe value here");
        return;
    }
    if (!derivativesOf(item).empty()) {
        error(item, finding::stopPair,
              "is safe=\"stop\" between two that are: " + inQuotes(base.name) +
                  ", whose derivative it is, and " + inQuotes(derivativesOf(item)[0]->name),
              "write safe=\"0\" for the highest derivative");
        return;
    }
    if (item.rate && !base.rate && !type_.isAbstract) {
        error(base, finding::stopRate,
              "is safe=\"stop\" and " + inQuotes(item.name) +
                  " slows down by its rate, but nothing bounds how fast it goes on till then",
              "state rate=\"…\" for " + inQuotes(base.name) + ", the greatest " +
                  inQuotes(item.name));
    }
    const bool mayStand =
        (!item.min || *item.min <= Number{0.0}) && (!item.max || Number{0.0} <= *item.max);
    if (mayStand) return;
    error(item, finding::stopPair, "is safe=\"stop\", but its range leaves 0 out",
          "widen the range, or write another safe value");
}

ItemProblems derivativeProblems(const Type& type) {
    return std::move(Derivatives{type}.problems());
}

}  // namespace

void checkDerivatives(const Type& type, std::span<const Type* const> parents, Report& report) {
    reportProblems(type, parents, derivativeProblems, report);
}

}  // namespace cortex
