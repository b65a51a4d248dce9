// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include <set>
#include <span>
#include <string>
#include <vector>

namespace cortex {

// What is wrong with an item of a type in view of another one. The place of the finding is that of
// the item, or of the other one where only that is stated by the type.
struct ItemProblem {
    const DataItem* item;
    const char* rule;
    std::string message, remedy;
    const DataItem* other = nullptr;
};
using ItemProblems = std::vector<ItemProblem>;

// Reports what this type states or joins itself: its parents' mistakes are found with them.
void reportProblems(const Type& type, std::span<const Type* const> parents,
                    ItemProblems (*problemsOf)(const Type& type), Report& report);

// The items that lead back to themselves, each naming the next one of the type by `link`.
std::set<const DataItem*> loopsOf(const Type& type, std::string DataItem::* link);

// The names nearest to one that no item of the type has; `otherwise` where none is near.
std::string nearestItems(const Type& type, const std::string& wrong, const char* otherwise);

}  // namespace cortex
