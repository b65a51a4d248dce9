// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

namespace cortex::gui {

// Whether what was entered for the one is the same of the other. In another unit, or with other
// labels, the same number is something else.
inline bool meansTheSame(const DataItem& one, const DataItem& other) {
    return one.kind == other.kind && one.length == other.length && one.unit == other.unit &&
           one.labels == other.labels;
}

}  // namespace cortex::gui
