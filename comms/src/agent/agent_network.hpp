// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "agent/agent_self.hpp"
#include "dds/network_interfaces.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::comms {

// What the network of an agent is like, told in events: at the start what keeps others from being
// heard, after a while that nobody is heard, and later what becomes of its interfaces.
// Communication thread only, after the constructor.
class AgentNetwork {
public:
    AgentNetwork(const AgentSelf& self, NetworkOptions options);

    // With which the network can be joined now: a named interface without an address waits. Without
    // a name, and where participants of this machine keep to the loopback interface, that one is
    // joined as well.
    NetworkOptions options();
    // `others`: how many agents are heard; `waits`: a simplex of one that is not. True: no address
    // with which the network was joined is left, and there are others, so it is to be joined anew.
    bool look(std::uint32_t others, bool waits, std::int64_t now);

private:
    bool follow();
    bool keepsToLoopback() const;
    std::vector<NetworkInterface> used() const;
    void tellApart() const;
    void tellElsewhere() const;
    std::string gain(const std::vector<std::string>& has, bool joins) const;
    void tellAlone() const;

    const AgentSelf& self_;
    const NetworkOptions asked_;
    std::vector<NetworkInterface> known_;
    std::vector<std::string> joined_;  // that of the loopback interface where there is no other
    std::int64_t due_ = 0;             // monotonic, ns
    bool alsoLoopback_ = false, begun_ = false, met_ = false, told_ = false;
};

}  // namespace cortex::comms
