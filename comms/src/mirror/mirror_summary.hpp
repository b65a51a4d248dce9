// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/simplex_mark.hpp"
#include "cortex/core/structure.hpp"

#include "peers/moment.hpp"
#include "wire/messages.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cortex::comms {

// How the simplexes of one agent are, as its newest summary says.
class MirrorSummary {
public:
    // Of an agent with so many simplexes of its own. False: it is refused, whole.
    bool take(const Summary& summary, std::size_t own, Moment when);
    bool any() const { return !octets_.empty(); }
    // By index; those of other agents are lost. `period` is that of the agent in ns: what has not
    // come again for too long is stale.
    std::vector<SimplexMark> marks(const Structure& structure, bool lost, std::int64_t period,
                                   Moment now) const;

private:
    std::vector<std::uint8_t> octets_;
    std::int64_t cycle_ = 0;
    Moment when_{};
};

}  // namespace cortex::comms
