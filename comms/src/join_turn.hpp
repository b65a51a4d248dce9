// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cortex::comms {

// The participants of one host join a domain one after another: everybody who joins talks with all
// who are there, and 100 at once on two cores would never be done, as what is lost is sent again.
class JoinTurn {
public:
    explicit JoinTurn(
        int domain);  // waits until it is ours; not for ever, if somebody stands still
    ~JoinTurn();      // the next one's
    JoinTurn(const JoinTurn&) = delete;
    JoinTurn& operator=(const JoinTurn&) = delete;

    // Waits until so many others on this host should have answered; the turn is kept meanwhile.
    void letAnswer(int others) const;

private:
    int socket_;
};

}  // namespace cortex::comms
