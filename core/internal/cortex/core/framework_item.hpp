// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include <string>
#include <string_view>

namespace cortex {

// Handle to an item that only the framework writes, such as `state`; Simplex::data() refuses those.
// Throws Error if the simplex has no such item of that kind.
template <class T>
Data<T> frameworkItem(AgentRuntime& agent, std::uint32_t simplex, std::string_view item) {
    const SimplexInfo& info = agent.structure().simplexes[simplex];
    const ItemLayout* layout = info.layout->find(item);
    if (layout == nullptr || layout->item->kind != kindFor<T>() || layout->item->length != 1 ||
        layout->constant) {
        throw Error(info.path + ": the framework writes an item '" + std::string{item} +
                    "' that type " + info.layout->type->name + " lacks or states otherwise");
    }
    void* cell = agent.tables().live(simplex).at(layout->item->kind, layout->offset);
    return Data<T>{static_cast<typename StorageOf<T>::type*>(cell)};
}

}  // namespace cortex
