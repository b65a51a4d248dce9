// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/type_model.hpp"

#include "types/stated.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex {

// The type that is being resolved, as the merging of its items sees it.
struct TypeContext {
    const std::string& type;
    Place place;  // of the type
    Report& report;
    // Whether one type is another or its child; true where that cannot be known.
    std::function<bool(std::string_view type, std::string_view base)> isA;
};

// One item of it: what findings about it say and where they point.
struct ItemContext {
    TypeContext& type;
    std::string what;  // "data 'position'", "rule 'axes'"
    Place place;

    void error(const char* rule, const std::string& message, std::string remedy = {}) const {
        type.report.error(type.type, rule, place, what + " " + message, std::move(remedy));
    }
    // Two parents do not agree, and the child may settle it.
    void restate(const char* attribute, const std::string& first, const std::string& second,
                 const std::string& firstParent, const std::string& secondParent) const;
    // Two parents exclude each other.
    void exclude(const std::string& attribute, const std::string& first, const std::string& second,
                 const std::string& firstParent, const std::string& secondParent) const;
};

// A definition of one name by a parent.
template <class Item>
struct FromParent {
    const Item* item;
    std::string parent;
};

// What a whole type only repeats is still defined by the parent that it has it from.
template <class Item>
void keepOrigin(Item& merged, const std::vector<FromParent<Item>>& parents, const Stated& stated) {
    if (!stated.isWhole() || parents.empty()) return;
    Item repeated = merged;
    repeated.definedBy = parents.front().item->definedBy;
    repeated.place = parents.front().item->place;
    if (repeated == *parents.front().item) merged = std::move(repeated);
}

// The definition of one item of a type from those of its parents (none: it is new) and its own
// statement (null: none). The result is checked; what is wrong goes to the report.
DataItem mergeData(const std::vector<FromParent<DataItem>>& parents, const DataItem* own,
                   const Stated& stated, const ItemContext& context);
Command mergeCommand(const std::vector<FromParent<Command>>& parents, const Command* own,
                     const Stated& stated, const ItemContext& context);
Rule mergeRule(const std::vector<FromParent<Rule>>& parents, const Rule* own, const Stated& stated,
               const ItemContext& context);

// Steps of mergeData: length, capacity and what a kind has no use for; bounds, default and safe
// value of the kind and length of `shape`; what a merged item must fulfil. What is wrong is
// dropped.
void checkShape(DataItem& own, const Stated& stated, const ItemContext& context);
void fitData(DataItem& own, const DataItem& shape, const ItemContext& context);
void checkData(DataItem& item, const DataItem* own, const ItemContext& context);

// What an item without a default starts with: zero, false or "", moved into its range.
Value implicitValue(const DataItem& item);

// Octets of a request or response with these parameters.
std::size_t recordSize(const std::vector<DataItem>& parameters);

}  // namespace cortex
