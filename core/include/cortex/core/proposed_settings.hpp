// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/data.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace cortex {

// An item that `set` may change: its check, which knows where a request holds it, and its cell.
struct SettableItem {
    const ArgumentCheck* check;
    void* cell;

    // Copies its value from a request of `set`.
    void store(const std::byte* request) const CORTEX_REALTIME;
};

// The values that a simplex would have after a `set`, before it is applied. Each item is asked by
// its own handle: `proposed[low_]` is what it would be, `low_` what it is. Seen only inside the
// hook settingsProposed().
class ProposedSettings {
public:
    // `request`: of `set`, checked item by item; null: nothing would change.
    ProposedSettings(std::span<const SettableItem> items, const std::byte* request)
        : items_{items}, request_{request} {}

    // An item that the request does not name, or that cannot be set, keeps its value.
    template <class T>
    CellReference<const T> operator[](const Data<T>& item) const CORTEX_REALTIME {
        using Cell = typename StorageOf<const T>::type;
        return CellReference<const T>{static_cast<Cell*>(valueOf(&item.cell()))};
    }
    template <class T>
    CellReference<const T> operator[](const CellReference<T>& item) const CORTEX_REALTIME {
        using Cell = typename StorageOf<const T>::type;
        return CellReference<const T>{static_cast<Cell*>(valueOf(item.cell_))};
    }
    template <ArrayElement T>
    std::span<const T> operator[](std::span<T> items) const CORTEX_REALTIME {
        return {static_cast<const T*>(valueOf(items.data())), items.size()};
    }
    // Whether the request names this item, be its value another one or not.
    template <class T>
    bool names(const Data<T>& item) const CORTEX_REALTIME {
        return valueOf(&item.cell()) != &item.cell();
    }
    template <ArrayElement T>
    bool names(std::span<T> items) const CORTEX_REALTIME {
        return valueOf(items.data()) != items.data();
    }
    // Nothing is applied, and the sender gets the text. The first refusal is kept.
    void refuse(std::string_view why) CORTEX_REALTIME {
        if (!why_) why_.emplace(why);
    }
    const std::optional<EventText>& refusal() const { return why_; }

private:
    const void* valueOf(const void* cell) const CORTEX_REALTIME;

    std::span<const SettableItem> items_;
    const std::byte* request_;
    std::optional<EventText> why_;
};

// Who is asked before a `set` is applied, and told afterwards.
struct SettingsHooks {
    void* object = nullptr;
    void (*proposed)(void* object, ProposedSettings& proposed) = nullptr;
    void (*changed)(void* object) = nullptr;
};

}  // namespace cortex
