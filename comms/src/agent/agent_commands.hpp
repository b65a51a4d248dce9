// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command_exchange.hpp"
#include "cortex/core/spsc_ring.hpp"

#include "agent/agent_self.hpp"
#include "wire/messages.hpp"
#include "wire/presence_interval.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace cortex::comms {

class SecurityIdentity;

// Commands from the network: what fits goes to the loop, the rest is answered at once; answers of
// the loop go back. Tells the loop when a sender is no longer heard. read() and write() in the
// loop, the rest on the communication thread.
class AgentCommands {
public:
    // With an identity, senders need to prove that they may command.
    AgentCommands(AgentSelf& self, std::function<void(const Answer&)> send,
                  SecurityIdentity* identity = nullptr);

    void take(const Command& command, std::int64_t now);
    // A presence of a sender, or its end.
    void heard(const Presence& presence, std::int64_t now);
    void lost(const std::string& sender, std::int64_t epoch);
    void step(std::int64_t now);
    bool knows(const std::string& sender) const { return senders_.contains(sender); }

    void read(Inbox& inbox) CORTEX_REALTIME;
    bool write(Outbox& outbox) CORTEX_REALTIME;  // whether there are answers to send

private:
    struct HeardSender {
        Sender sender;
        std::int64_t lastHeard = 0, patience = shortestPatience;
        std::uint64_t newest = 0;              // sequence number that the loop was given
        std::set<std::uint64_t> turnedAway{};  // that it was not given, as far as unacknowledged
    };
    struct Refusal {
        Outcome outcome;
        Reason reason;
        std::string why;
    };
    bool believable(const Command& command);
    bool remember(const Sender& sender, std::int64_t now);
    bool tellLost(const Sender& sender);
    void refuse(const Command& command, const Refusal& refusal);
    void turnAway(const Command& command, HeardSender& from);
    bool permitted(const Command& command, const OutsideCommand& message,
                   const std::vector<std::uint64_t>& record, Refusal& refusal);
    bool encode(const Command& command, OutsideCommand& message, std::vector<std::uint64_t>& record,
                Refusal& refusal) const;
    Answer answerFor(const OutsideAnswer& answer) const;

    AgentSelf& self_;
    std::function<void(const Answer&)> send_;
    SecurityIdentity* identity_;
    CommandPipe pipe_;
    SpscRing<Sender> lostSenders_;
    std::map<std::string, HeardSender> senders_;  // by name
    Id reportedLink_{};                           // of the last command that was not permitted
    std::uint64_t reportedNumber_ = 0;
};

}  // namespace cortex::comms
