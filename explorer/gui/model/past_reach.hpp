// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"

#include <QString>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::gui {

// How far back goes what one agent has said of the past.
struct PastReach {
    std::string agent{};
    std::int64_t started = 0;  // UTC ns
    bool remembers = true;     // otherwise it has only what it sent last
    bool asking = true;        // it has not answered
    std::string trouble{};     // why not all of it has come; empty: it has
    std::vector<comms::PastEvents::Since> since{};
};

// "asking robot; zoo: it was built before agents kept a memory; table: commands are kept since …",
// of those whose memory does not go back to `from` (UTC ns). Empty: nobody was asked.
QString reachText(const std::vector<PastReach>& agents, std::int64_t from);

}  // namespace cortex::gui
