// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace cortex::comms {

// So many at once, and then one in each time of `each` ns. Times are ns of monotonicNow().
class Allowance {
public:
    bool take(std::int64_t now, std::int64_t most, std::int64_t each) {
        if (used_ > now + (most - 1) * each) return false;
        used_ = std::max(used_, now) + each;
        return true;
    }

private:
    std::int64_t used_ = 0;  // up to then, where it is used evenly
};

}  // namespace cortex::comms
