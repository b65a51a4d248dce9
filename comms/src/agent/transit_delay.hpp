// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace cortex::comms {

// Measures how much longer a message of one sender took than the quickest one of the last 10 to 20
// s: in its threads, on the network and in our queues. Clocks of hosts are never compared, so what
// all messages take is not seen. The drift of clocks does not matter in so short a time.
class TransitDelay {
public:
    // The delay of the next message: `sent` by the sender's clock, `came` by ours; ns, below 2^62.
    std::int64_t next(std::int64_t sent, std::int64_t came) {
        if (sent < newest_) *this = {};  // its clock was set back
        newest_ = sent;
        const std::int64_t way = came - sent;  // includes the difference of the two clocks
        if (came >= turn_) {
            before_ = turn_ == 0 ? way : least_;
            least_ = way;
            turn_ = came + window;
        }
        least_ = std::min(least_, way);
        return way - std::min(before_, least_);
    }

private:
    static constexpr std::int64_t window = 10'000'000'000;  // ns

    std::int64_t newest_ = std::numeric_limits<std::int64_t>::min();
    std::int64_t turn_ = 0;  // when the next window begins
    std::int64_t before_ = 0, least_ = 0;
};

}  // namespace cortex::comms
