// SPDX-License-Identifier: Apache-2.0
#include "commands/unset_arguments.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <string_view>
#include <variant>
#include <vector>

namespace cortex {
namespace {

constexpr std::uint64_t unsetFloat = 0x7ff8c0ffee0ddba1U;  // a NaN, which stays one when counted
constexpr std::int64_t unsetInt = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t lastUnsetInt = unsetInt + (std::int64_t{1} << 32);  // counted, never set
constexpr std::byte unsetBool{2};
constexpr std::string_view unsetText = "\xff";  // no UTF-8

struct Element {
    const DataItem& item;
    std::byte* cell;

    void mark() const {
        switch (item.kind) {
            case Kind::Int:
                *reinterpret_cast<std::int64_t*>(cell) = unsetInt;
                return;
            case Kind::Float:
                *reinterpret_cast<double*>(cell) = std::bit_cast<double>(unsetFloat);
                return;
            case Kind::Bool:
                *cell = unsetBool;
                return;
            case Kind::String:
                reinterpret_cast<StringCell*>(cell)->assign(unsetText);
        }
    }
    bool isUnset() const CORTEX_REALTIME {
        switch (item.kind) {
            case Kind::Int:
                return *reinterpret_cast<const std::int64_t*>(cell) <= lastUnsetInt;
            case Kind::Float:
                return *reinterpret_cast<const std::uint64_t*>(cell) == unsetFloat;
            case Kind::Bool:
                return *cell == unsetBool;
            case Kind::String:
                break;
        }
        return reinterpret_cast<const StringCell*>(cell)->view() == unsetText;
    }
    // What a parameter without a default begins with for its receiver, too.
    void clear() const CORTEX_REALTIME {
        if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&item.initial))
            *reinterpret_cast<std::int64_t*>(cell) = ints->front();
        else if (const auto* floats = std::get_if<std::vector<double>>(&item.initial))
            *reinterpret_cast<double*>(cell) = floats->front();
        else if (item.kind == Kind::Bool)
            *cell = std::byte{0};
        else
            reinterpret_cast<StringCell*>(cell)->assign({});
    }
};

template <class Action>
void forElements(const ItemLayout& layout, std::byte* request, Action action) {
    const DataItem& item = *layout.item;
    const std::uint32_t stride = item.kind == Kind::String ? StringCell::size(item.capacity)
                                 : item.kind == Kind::Bool ? 1
                                                           : 8;
    for (std::uint32_t i = 0; i < item.length; ++i) {
        action(Element{item, request + layout.offset + i * stride});
    }
}

bool isRequired(const CommandTable::Entry& entry, const DataItem& item) {
    return entry.command != nullptr && !item.hasDefault;
}

}  // namespace

bool markUnset(const CommandTable::Entry& entry, std::byte* request) {
    bool any = false;
    for (const ItemLayout& layout : entry.request.items) {
        if (!isRequired(entry, *layout.item)) continue;
        forElements(layout, request, [](const Element& element) { element.mark(); });
        any = true;
    }
    return any;
}

const DataItem* findUnset(const CommandTable::Entry& entry, std::byte* request) {
    for (const ItemLayout& layout : entry.request.items) {
        if (!isRequired(entry, *layout.item)) continue;
        std::uint32_t unset = 0;
        const auto count = [&](const Element& element) { unset += element.isUnset() ? 1 : 0; };
        forElements(layout, request, count);
        if (unset == layout.item->length) return layout.item;
        if (unset == 0) continue;
        forElements(layout, request, [](const Element& element) {
            if (element.isUnset()) element.clear();
        });
    }
    return nullptr;
}

}  // namespace cortex
