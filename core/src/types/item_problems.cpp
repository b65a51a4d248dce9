// SPDX-License-Identifier: Apache-2.0
#include "types/item_problems.hpp"

#include "cortex/core/nearest_names.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cortex {

namespace {

Place placeOf(const Type& type, const ItemProblem& problem) {
    for (const DataItem* each : {problem.item, problem.other}) {
        const bool own = each && each->definedBy == type.name && !each->place.file.empty();
        if (own) return each->place;
    }
    return type.place;
}

}  // namespace

void reportProblems(const Type& type, std::span<const Type* const> parents,
                    ItemProblems (*problemsOf)(const Type& type), Report& report) {
    const ItemProblems problems = problemsOf(type);
    if (problems.empty()) return;
    std::set<std::pair<std::string, std::string>> inherited;
    for (const Type* parent : parents) {
        for (ItemProblem& each : problemsOf(*parent)) {
            inherited.emplace(each.item->name, std::move(each.message));
        }
    }
    for (const ItemProblem& each : problems) {
        if (inherited.contains({each.item->name, each.message})) continue;
        report.error(type.name, each.rule, placeOf(type, each),
                     "data " + inQuotes(each.item->name) + " " + each.message, each.remedy);
    }
}

std::set<const DataItem*> loopsOf(const Type& type, std::string DataItem::* link) {
    const auto next = [&](const DataItem* item) {
        return (item->*link).empty() ? nullptr : type.findData(item->*link);
    };
    std::set<const DataItem*> loops;
    std::map<const DataItem*, const DataItem*> walkOf;  // where the walk began that came by
    for (const DataItem& first : type.data) {
        const DataItem* each = &first;
        while (each != nullptr && walkOf.emplace(each, &first).second) each = next(each);
        if (each == nullptr || walkOf[each] != &first) continue;
        while (loops.insert(each).second) each = next(each);
    }
    return loops;
}

std::string nearestItems(const Type& type, const std::string& wrong, const char* otherwise) {
    std::vector<std::string> names;
    for (const DataItem& each : type.data) names.push_back(each.name);
    const std::string near = nearestNames(wrong, names);
    return near.empty() ? otherwise : near;
}

}  // namespace cortex
