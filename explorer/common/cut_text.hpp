// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <cstddef>
#include <string_view>

namespace cortex::common {

// Whether a text takes all of so many bytes, so that it may have been cut. No character is cut in
// two: behind a text that is not all ASCII up to three bytes may be free.
bool fills(std::string_view text, std::size_t capacity);

// Whether this may be the beginning of a longer text only. What is set, or is constant, is refused
// where it does not fit.
bool mayBeCut(const DataItem& item, const Value& value, std::size_t element = 0);

}  // namespace cortex::common
