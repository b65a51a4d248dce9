// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace cortex::test {

// Cases that tests/kinds.cmake lists as `whole` do a tenth of their work in the gate. With all of
// it they run once more, in stage `long`, where CORTEX_WHOLE is set.
inline bool isWhole() { return std::getenv("CORTEX_WHOLE") != nullptr; }

template <class Count>
Count share(Count whole) {
    return isWhole() ? whole : whole / 10;
}

}  // namespace cortex::test
