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
#include <vector>

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

    struct Edit {
        Value value;
        DataItem item;                     // as it was then
        std::set<std::size_t> elements{};  // that were entered; empty: all
        std::uint64_t count = 0;           // when it was entered last
        bool isFresh = true;               // its simplex was not left since
    };
    using All = std::map<std::string, Edit>;  // by item

    explicit ItemEdits(Now now) : now_{std::move(now)} {}

    void enter(const DataItem& item, Value value);
    // False: the other elements are not known.
    bool enter(const DataItem& item, std::size_t element, const Value& value);
    static std::uint64_t count() { return count_; }  // of all that was entered anywhere, ever
    // Those that were sent, as they were at that count.
    void clear(const Values& sent, std::uint64_t count) { clear(edits_, sent, count); }
    static void clear(All& edits, const Values& sent, std::uint64_t count);

    All take() { return std::exchange(edits_, {}); }  // another simplex is shown
    void put(All edits);                              // it is shown again
    // Forgets those that would mean something else by now, and names them. `now`: null where there
    // is no such item.
    std::vector<std::string> dropChanged(
        const std::function<const DataItem*(const std::string& item)>& now);

    std::size_t size() const { return edits_.size(); }
    Values all() const;
    Values fresh(const std::string& also) const;             // and that one
    std::optional<Value> of(const std::string& item) const;  // none: nothing was entered
    std::optional<Value> of(const std::string& item, std::size_t element) const;

private:
    Value merged(const std::string& item, const Edit& edit) const;

    Now now_;
    All edits_;
    static inline std::uint64_t count_ = 0;
};

// What was entered for simplexes that no table shows just now. One window has one.
struct KeptEdits {
    std::map<std::string, ItemEdits::All> byPath{};

    void put(const std::string& path, ItemEdits::All edits);
    ItemEdits::All take(const std::string& path);
    std::size_t size() const;  // values
};

}  // namespace cortex::gui
