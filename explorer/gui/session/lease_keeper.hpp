// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::gui {

// What the window does with control: it takes one part of the plant at a time, hands it over, and
// accepts what is handed over to it. No call waits, but the end. Session thread.
class LeaseKeeper {
public:
    // `security`: the folder of this session, which the mirror has checked; empty: none.
    LeaseKeeper(comms::Mirror& mirror, const std::string& security);

    // Of all agents that have something at or below the prefix, or of none. What was held before
    // is held until then, and stays so where a part of it was lost and is taken again.
    void take(const std::string& prefix, const Frame& frame);
    void release();
    void handOver(const std::string& prefix, const std::string& to);
    // Takes answers in. A window that does not answer must not hold a plant: `renews` is false
    // then.
    void step(const Frame& frame, bool renews);
    const Control& now() const { return control_; }

private:
    void finishTaking(const Frame& frame, const comms::LeaseClient::Answers& answers);
    void finishHandOver(const comms::LeaseClient::Answers& answers);
    void tell(std::string notice);
    void noteHeld();
    void releaseAllBut(const std::string& prefix);

    Control control_;
    std::uint64_t taking_ = 0, handing_ = 0;  // numbers of the client; 0: none
    bool again_ = false;  // it takes what is missing of a claim: all others stay
    std::vector<std::uint64_t> releasing_;
    std::string handed_, to_;
    comms::LeaseClient client_;  // ends first, and releases all within a second
};

}  // namespace cortex::gui
