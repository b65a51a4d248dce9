// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cortex::gui {

// What is asked of the past of an agent, UTC ns by its clock.
struct PastAsk {
    std::uint64_t number = 0;
    std::string agent;
    std::int64_t from = 0, until = 0;
};

struct PastAnswer {
    std::uint64_t number = 0;
    comms::PastEvents past;
};

// What was asked of the past, and is not answered. Session thread.
class PastAsks {
public:
    explicit PastAsks(comms::Mirror& mirror) : mirror_{mirror} {}

    using Moment = std::chrono::steady_clock::time_point;

    void ask(const PastAsk& ask);
    // What has come, after the live events that are older, as far as they come soon.
    std::vector<PastAnswer> step(Moment now);

private:
    comms::Mirror& mirror_;
    std::map<std::uint64_t, std::uint64_t> asked_;  // number of the mirror, and of who asks
    std::vector<PastAnswer> came_;
    Moment since_;  // the first of them came
};

}  // namespace cortex::gui
