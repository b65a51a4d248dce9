// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace cortex::comms {

// The participants of one host join a domain one after another: everybody who joins talks with all
// who are there, and while one of them lacks something, Fast DDS asks all of them again.
class JoinTurn {
public:
    // Waits until it is ours; not for ever, if somebody stands still.
    explicit JoinTurn(int domain);
    ~JoinTurn();  // the next one's
    JoinTurn(const JoinTurn&) = delete;
    JoinTurn& operator=(const JoinTurn&) = delete;

    // Waits as long as it takes a discovery server and so many others to talk about us.
    void letAnswer(std::uint32_t others) const;
    // Without a server: waits until so many others are met, or nobody new is met for a while; the
    // turn is kept meanwhile.
    void meet(std::uint32_t others, const std::function<std::uint32_t()>& met) const;

private:
    int socket_;
};

}  // namespace cortex::comms
