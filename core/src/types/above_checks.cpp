// SPDX-License-Identifier: Apache-2.0
#include "types/above_checks.hpp"

#include "cortex/core/findings.hpp"

#include "base/text.hpp"
#include "types/item_problems.hpp"
#include "types/unit.hpp"

#include <optional>

namespace cortex {

namespace {

bool isNumber(Kind kind) { return kind == Kind::Int || kind == Kind::Float; }

// An abstract type may leave the unit of either to its children.
bool haveOneUnit(const DataItem& item, const DataItem& other) {
    return item.unit == other.unit || item.unit == openUnit || other.unit == openUnit;
}

std::string textOf(const std::string& unit) {
    return unit.empty() ? "no unit" : "the unit " + inQuotes(unit);
}

struct Words {
    std::string message, remedy;
};

// What keeps the values of two items from being compared.
std::optional<Words> differenceOf(const DataItem& item, const DataItem& other) {
    if (&item == &other) return Words{", which is itself", "name the item that it must be above"};
    if (item.kind != other.kind || !isNumber(item.kind)) {
        return Words{
            std::string{", but is "} + name(item.kind) + ", and that one " + name(other.kind),
            "write kind=\"float\" or kind=\"int\" for both, or remove above"};
    }
    if (item.length != 1 || other.length != 1) {
        return Words{", but not both are single numbers",
                     "leave length out for both, or remove above"};
    }
    if (!haveOneUnit(item, other)) {
        return Words{", but " + textOf(item.unit) + ", and that one has " + textOf(other.unit),
                     "give both one unit: nothing is converted"};
    }
    if (!item.constant || !other.constant) {
        const DataItem& wrong = item.constant ? other : item;
        return Words{", but " + inQuotes(wrong.name) + " is not constant",
                     "write constant=\"true\" for both, or remove above: only what never changes "
                     "is compared"};
    }
    return {};
}

// An abstract type may leave the defaults to its children.
bool areJudged(const Type& type, const DataItem& item, const DataItem& other) {
    return !type.isAbstract || (item.hasDefault && other.hasDefault);
}

std::optional<Words> faultOf(const Type& type, const DataItem& item, const DataItem* other) {
    const std::string what = "has above=" + inQuotes(item.above);
    if (other == nullptr) {
        return Words{what + ", which is no item of this type",
                     nearestItems(type, item.above, "name the item that it must be above")};
    }
    std::optional<Words> words = differenceOf(item, *other);
    if (words) words->message = what + words->message;
    return words;
}

void addDefaultProblem(const Type& type, const DataItem& item, const DataItem& other,
                       ItemProblems& problems) {
    if (!areJudged(type, item, other) || item.initial > other.initial) return;
    const std::string here = quantityText(item, item.initial),
                      there = quantityText(other, other.initial);
    problems.push_back({&item, finding::defaultAbove,
                        "has the default " + here + ", which is not above that of " +
                            inQuotes(other.name) + ", " + there,
                        "write a default above " + there + ", or one below " + here + " for " +
                            inQuotes(other.name),
                        &other});
}

ItemProblems problemsOf(const Type& type) {
    ItemProblems problems;
    const auto loops = loopsOf(type, &DataItem::above);
    for (const DataItem& item : type.data) {
        if (item.above.empty()) continue;
        const DataItem* other = type.findData(item.above);
        if (const auto words = faultOf(type, item, other)) {
            problems.push_back({&item, finding::above, words->message, words->remedy, other});
        } else if (loops.contains(&item)) {
            problems.push_back({&item, finding::above, "must be above itself by way of others",
                                "remove above from one of them", other});
        } else {
            addDefaultProblem(type, item, *other, problems);
        }
    }
    return problems;
}

}  // namespace

void checkAbove(const Type& type, std::span<const Type* const> parents, Report& report) {
    reportProblems(type, parents, problemsOf, report);
}

const DataItem* boundBelow(const Type& type, const DataItem& item) {
    const DataItem* other = item.above.empty() ? nullptr : type.findData(item.above);
    return other != nullptr && !differenceOf(item, *other) ? other : nullptr;
}

std::string quantityText(const DataItem& item, const Value& value) {
    const bool hasUnit = !item.unit.empty() && item.unit != openUnit;
    return toText(value) + (hasUnit ? " " + item.unit : "");
}

}  // namespace cortex
