// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace cortex::explorer {

// The control leases of one session: asked for, renewed every 0.5 s, released. No call waits, but
// the end. Session thread.
class LeaseKeeper {
public:
    explicit LeaseKeeper(comms::Mirror& mirror);
    ~LeaseKeeper();  // releases all, within a second
    LeaseKeeper(const LeaseKeeper&) = delete;
    LeaseKeeper& operator=(const LeaseKeeper&) = delete;

    // Of all agents that have something at or below the prefix, or of none. What was held before
    // is held until then.
    void take(const std::string& prefix, const Frame& frame);
    void release();
    // Takes answers in and renews. A window that does not answer must not hold a plant: `renews`
    // is false then.
    void step(const Frame& frame, bool renews);
    const Control& now() const { return control_; }

private:
    using Moment = std::chrono::steady_clock::time_point;
    enum class Phase { Asked, Held, Released };
    struct Kept {
        std::string agent, prefix;
        Phase phase = Phase::Asked;
        std::uint64_t number = 0;  // of the command that is on its way; 0: none
        Moment sent{}, renewed{};
        std::string refusal;
        bool rejected = false;  // by the agent: there is nothing to release
    };

    void send(Kept& kept, const char* command);
    void settle(Kept& kept, Moment now);
    void finishTaking(const Frame& frame);
    void renew(Kept& kept, Moment now);
    void tell(std::string text);

    comms::Mirror& mirror_;
    Control control_;
    std::string asked_;  // the prefix that is being taken; empty: none
    std::vector<Kept> kept_;
};

}  // namespace cortex::explorer
