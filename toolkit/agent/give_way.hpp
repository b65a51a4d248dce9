// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"

#include <cstdint>
#include <string>

namespace cortex::toolkit {

// --wait: another start of the name may have taken over while this one stood still, or was there
// first and is heard late. Then the devices are that one's: everything here is shut down until it
// has ended. Program's thread.
class GiveWay {
public:
    // `startsUp`: with --startup, so that the program starts everything up again.
    GiveWay(cs::ClusterCS& cluster, std::string agentName, bool startsUp);

    enum class Turn { Ours, Theirs, OursAgain };
    // Again and again, while the loop runs.
    Turn look(bool isSecond);
    bool isAway() const { return away_; }

private:
    void leave();
    void comeBack();

    cs::ClusterCS& cluster_;
    std::string name_;
    bool startsUp_, away_ = false;
    std::uint64_t sent_ = 0;  // a shutdown that was not answered yet
};

}  // namespace cortex::toolkit
