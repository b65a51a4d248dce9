// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"
#include "cortex/core/value.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace cortex::gui {

// One element of an array as a value, and as an item, of its own: "pose 3".
Value elementOf(const Value& value, std::size_t element);
DataItem elementItem(const DataItem& item, std::size_t element);

// What was entered for items of one simplex and is not sent yet. Of an array of which elements were
// entered, the others are as the agent has them now.
class ItemEdits {
public:
    using Values = std::map<std::string, Value>;
    // What the agent has; none: it is not known.
    using Now = std::function<std::optional<Value>(const std::string& item)>;

    explicit ItemEdits(Now now) : now_{std::move(now)} {}

    void enter(const std::string& item, Value value);
    // False: the other elements are not known.
    bool enter(const std::string& item, std::size_t element, const Value& value);
    std::uint64_t count() const { return count_; }  // of all that was entered, ever
    void clear(std::uint64_t count);                // what was entered up to that count

    Values all() const;
    std::optional<Value> of(const std::string& item) const;  // none: nothing was entered
    std::optional<Value> of(const std::string& item, std::size_t element) const;

private:
    struct Edit {
        Value value;
        std::set<std::size_t> elements{};  // that were entered; empty: all
        std::uint64_t count = 0;           // when it was entered last
    };
    Value merged(const std::string& item, const Edit& edit) const;

    Now now_;
    std::map<std::string, Edit> edits_;  // by item
    std::uint64_t count_ = 0;
};

}  // namespace cortex::gui
