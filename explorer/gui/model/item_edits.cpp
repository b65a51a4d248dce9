// SPDX-License-Identifier: Apache-2.0
#include "model/item_edits.hpp"

#include <type_traits>

namespace cortex::gui {

namespace {

// Values of another kind, or beyond the end, change nothing.
void setElement(Value& value, std::size_t element, const Value& one) {
    std::visit(
        [&](auto& all) {
            const auto* entered = std::get_if<std::remove_cvref_t<decltype(all)>>(&one);
            if (entered == nullptr || entered->empty() || element >= all.size()) return;
            all[element] = entered->front();
        },
        value);
}

}  // namespace

Value elementOf(const Value& value, std::size_t element) {
    return std::visit(
        [&](const auto& all) -> Value {
            std::remove_cvref_t<decltype(all)> one;
            if (element < all.size()) one.push_back(all[element]);
            return one;
        },
        value);
}

DataItem elementItem(const DataItem& item, std::size_t element) {
    DataItem one = item;
    one.length = 1;
    one.name += ' ' + std::to_string(element + 1);
    return one;
}

void ItemEdits::enter(const std::string& item, Value value) {
    edits_[item] = {std::move(value), {}, ++count_};
}

void ItemEdits::clear(std::uint64_t count) {
    std::erase_if(edits_, [count](const auto& each) { return each.second.count <= count; });
}

bool ItemEdits::enter(const std::string& item, std::size_t element, const Value& value) {
    auto found = edits_.find(item);
    if (found == edits_.end()) {
        auto now = now_(item);
        if (!now) return false;
        found = edits_.emplace(item, Edit{std::move(*now), {element}}).first;
    }
    Edit& edit = found->second;
    edit.count = ++count_;
    setElement(edit.value, element, value);
    if (!edit.elements.empty()) edit.elements.insert(element);
    return true;
}

Value ItemEdits::merged(const std::string& item, const Edit& edit) const {
    auto now = edit.elements.empty() ? std::nullopt : now_(item);
    if (!now || lengthOf(*now) != lengthOf(edit.value)) return edit.value;
    for (const std::size_t each : edit.elements) {
        setElement(*now, each, elementOf(edit.value, each));
    }
    return *now;
}

ItemEdits::Values ItemEdits::all() const {
    Values all;
    for (const auto& [item, edit] : edits_) all[item] = merged(item, edit);
    return all;
}

std::optional<Value> ItemEdits::of(const std::string& item) const {
    const auto found = edits_.find(item);
    if (found == edits_.end()) return std::nullopt;
    return merged(item, found->second);
}

std::optional<Value> ItemEdits::of(const std::string& item, std::size_t element) const {
    const auto found = edits_.find(item);
    if (found == edits_.end()) return std::nullopt;
    const Edit& edit = found->second;
    if (!edit.elements.empty() && !edit.elements.contains(element)) return std::nullopt;
    return elementOf(edit.value, element);
}

}  // namespace cortex::gui
