// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cortex {

std::vector<ArgumentCheck> compileChecks(const RecordLayout& layout);
// Whether the elements are finite, in range, labelled where only labels are valid, and fit.
// Otherwise `why` says in words what is wrong.
bool checkElements(const ArgumentCheck& check, const std::byte* record,
                   std::optional<EventText>& why) CORTEX_REALTIME;
// The first of these float items with an element that is not finite; null: all are numbers.
const DataItem* notFinite(std::span<const ArgumentCheck> floats, const std::byte* record)
    CORTEX_REALTIME;
// Whether this is one number in its range, as most are. If it is not, ask checkElements().
inline bool isOneNumberInRange(const ArgumentCheck& check, const std::byte* record)
    CORTEX_REALTIME {
    if (check.length != 1) return false;
    if (check.kind == Kind::Float) {
        const double value = *reinterpret_cast<const double*>(record + check.offset);
        return value >= check.minFloat && value <= check.maxFloat;
    }
    if (check.kind != Kind::Int || check.closed) return false;
    const std::int64_t value = *reinterpret_cast<const std::int64_t*>(record + check.offset);
    return value >= check.minInt && value <= check.maxInt;
}
inline bool checkArgument(const ArgumentCheck& check, const std::byte* record,
                          std::optional<EventText>& why) CORTEX_REALTIME {
    return isOneNumberInRange(check, record) || checkElements(check, record, why);
}

}  // namespace cortex
