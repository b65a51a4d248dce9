// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::gui {

// What the window does with control: it takes one part of the plant at a time, hands all over, asks
// others and answers them, and accepts what is handed over to it. No call waits, but the end.
// Session thread.
class LeaseKeeper {
public:
    using Asked = comms::LeaseClient::Asked;

    // `person`: who uses the window. `security`: the folder of this session, which the mirror has
    // checked; empty: none.
    LeaseKeeper(comms::Mirror& mirror, const std::string& person, const std::string& security);

    // Of all agents that have something at or below the prefix, or of none. What was held before
    // is held until then, and stays so where a part of it was lost and is taken again. While
    // something else is being taken, it is taken after that.
    void take(const std::string& prefix, const Frame& frame);
    void release();                        // also what is being taken
    void handOver(const std::string& to);  // all that is held, as one act
    void ask(const std::string& prefix);
    void withdraw();
    void grant(const Asked& asked);
    void refuse(const Asked& asked);
    // Takes answers in. A window that does not answer must not hold a plant: `renews` is false
    // then.
    void step(const Frame& frame, bool renews);
    const Control& now() const { return control_; }

private:
    using Lease = comms::LeaseClient::Lease;
    // One call of the client.
    struct Part {
        std::uint64_t number = 0;
        std::vector<std::string> prefixes;
        bool answered = false;
        std::string refusals{};  // " mixer: Rejected (authority): …."
        std::string words{};     // "everything of robot"; empty: all of its prefixes go
    };
    // What goes to somebody in one act.
    struct Giving {
        std::string to;
        std::vector<Part> parts;
    };

    void finishTaking(const comms::LeaseClient::Answers& answers);
    bool finishGiving(Giving& giving);  // false: some have not answered
    void tell(const std::string& notice);
    void noteAll();
    void releaseAllBut(const std::string& prefix);

    comms::Mirror& mirror_;
    Control control_;
    std::uint64_t taking_ = 0;  // number of the client; 0: none
    bool again_ = false;        // it takes what is missing of a claim: all others stay
    bool inVain_ = false;       // what is being taken was released meanwhile
    std::string next_;          // to be taken after that; empty: nothing
    std::vector<std::uint64_t> releasing_;
    std::vector<Giving> givings_;
    std::string news_;  // the last that was told
    std::chrono::steady_clock::time_point lastNews_{};
    comms::LeaseClient client_;  // ends first, and releases all within a second
};

}  // namespace cortex::gui
