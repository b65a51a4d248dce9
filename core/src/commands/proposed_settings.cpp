// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/proposed_settings.hpp"

#include <cstdint>
#include <cstring>

namespace cortex {
namespace {

std::size_t strideOf(const ArgumentCheck& check) {
    if (check.kind == Kind::String) return StringCell::size(check.item->capacity);
    return check.kind == Kind::Bool ? 1 : 8;
}

}  // namespace

void SettableItem::store(const std::byte* request) const {
    const std::byte* from = request + check->offset;
    const std::size_t stride = strideOf(*check);
    if (check->kind != Kind::String) {
        std::memcpy(cell, from, check->length * stride);
        return;
    }
    for (std::uint32_t i = 0; i < check->length; ++i) {
        const auto& text = *reinterpret_cast<const StringCell*>(from + i * stride);
        auto* to = reinterpret_cast<StringCell*>(static_cast<std::byte*>(cell) + i * stride);
        to->assign(text.view());
    }
}

// A request begins with a flag for each item that can be set, in their order. An item lies in it
// as it lies in its table, so an element of an array is found by its distance from the first.
const void* ProposedSettings::valueOf(const void* cell) const {
    if (request_ == nullptr) return cell;
    const auto address = reinterpret_cast<std::uintptr_t>(cell);
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const ArgumentCheck& check = *items_[i].check;
        const std::size_t distance = address - reinterpret_cast<std::uintptr_t>(items_[i].cell);
        if (distance >= check.length * strideOf(check)) continue;
        return request_[i] == std::byte{0} ? cell : request_ + check.offset + distance;
    }
    return cell;
}

}  // namespace cortex
