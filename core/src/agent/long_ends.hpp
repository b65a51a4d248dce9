// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex {

// How the last long commands from outside ended. A sender that knows one to run has acknowledged
// it, so its end is in no window; where that answer was lost, it asks again. Loop thread only.
class LongEnds {
public:
    explicit LongEnds(std::uint32_t maxResponse);

    void keep(std::uint32_t interface, const OutsideAnswer& end) CORTEX_REALTIME;
    // False: it has not ended, or a thousand others have since.
    bool find(std::uint32_t interface, const Sender& sender, std::uint64_t sequence,
              OutsideAnswer& end) const CORTEX_REALTIME;

private:
    struct End {
        std::uint32_t interface = 0;
        OutsideAnswer answer;
    };
    std::vector<std::uint64_t> sequences_;  // of `ends_`, for a quick search; 0: none
    std::vector<End> ends_;                 // a ring
    std::vector<std::byte> responses_;
    std::size_t next_ = 0;
};

}  // namespace cortex
