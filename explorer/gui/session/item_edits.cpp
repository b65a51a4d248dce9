// SPDX-License-Identifier: Apache-2.0
#include "session/item_edits.hpp"

#include "session/item_meaning.hpp"

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

void ItemEdits::enter(const DataItem& item, Value value) {
    edits_[item.name] = {std::move(value), item, {}, ++count_};
}

void ItemEdits::clear(All& edits, const Values& sent, std::uint64_t count) {
    std::erase_if(edits, [&](const auto& each) {
        return each.second.count <= count && sent.contains(each.first);
    });
}

void ItemEdits::put(All edits) {
    edits_ = std::move(edits);
    for (auto& [item, edit] : edits_) edit.isFresh = false;
}

std::vector<std::string> ItemEdits::dropChanged(
    const std::function<const DataItem*(const std::string& item)>& now) {
    std::vector<std::string> dropped;
    std::erase_if(edits_, [&](const auto& each) {
        const DataItem* item = now(each.first);
        const bool changed = item != nullptr && !meansTheSame(*item, each.second.item);
        if (changed) dropped.push_back(each.first);
        return changed;
    });
    return dropped;
}

bool ItemEdits::enter(const DataItem& item, std::size_t element, const Value& value) {
    auto found = edits_.find(item.name);
    if (found == edits_.end()) {
        auto now = now_(item.name);
        if (!now) return false;
        found = edits_.emplace(item.name, Edit{std::move(*now), item, {element}}).first;
    }
    Edit& edit = found->second;
    edit.count = ++count_;
    edit.isFresh = true;
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

ItemEdits::Values ItemEdits::fresh(const std::string& also) const {
    Values all;
    for (const auto& [item, edit] : edits_) {
        if (edit.isFresh || item == also) all[item] = merged(item, edit);
    }
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

void KeptEdits::put(const std::string& path, ItemEdits::All edits) {
    if (edits.empty()) return;
    for (auto& [item, edit] : edits) byPath[path].insert_or_assign(item, std::move(edit));
}

ItemEdits::All KeptEdits::take(const std::string& path) {
    auto found = byPath.extract(path);
    return found.empty() ? ItemEdits::All{} : std::move(found.mapped());
}

std::size_t KeptEdits::size() const {
    std::size_t count = 0;
    for (const auto& [path, edits] : byPath) count += edits.size();
    return count;
}

}  // namespace cortex::gui
