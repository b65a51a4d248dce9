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
#include <vector>

namespace cortex::comms {

class AgentRivals;
class SecurityIdentity;

// Passes valid commands from the network to the loop and answers the others at once. It sends the
// answers of the loop, and tells the loop when a sender is lost. The loop calls read() and write();
// the communication thread calls the rest. Times are ns of monotonicNow(). A command from outside
// comes from another agent or a tool. Its sender is a name and an epoch, which grows with each
// start.
class AgentCommands {
public:
    // With an identity, a sender must prove that it may command. With rivals, commands to paths
    // that another agent owns are refused, but for those that came before it was known.
    AgentCommands(AgentSelf& self, std::function<void(const Answer&)> send,
                  SecurityIdentity* identity = nullptr, const AgentRivals* rivals = nullptr);

    // For each command that was received, those for other agents included.
    void take(const Command& command, std::int64_t now);
    // With each presence of a sender, and when it is lost.
    void heard(const Presence& presence, std::int64_t now);
    void lost(const std::string& sender, std::int64_t epoch);
    // Sends the answers of the loop. A sender whose presence is overdue is reported to the loop.
    void step(std::int64_t now);

    void read(Inbox& inbox) CORTEX_REALTIME;
    bool write(Outbox& outbox) CORTEX_REALTIME;  // whether answers are to be sent

private:
    struct HeardSender {
        Sender sender;
        std::int64_t lastHeard = 0;
        std::int64_t patience = shortestPatience;  // ns of silence after which it counts as lost
        std::uint64_t answeredBelow = 1;           // by sequence number, as the loop knows it
        std::set<std::uint64_t> passed{};          // numbers from there on that the loop was given
        std::set<std::uint64_t> turnedAway{};      // refused numbers that are not acknowledged
        std::map<std::uint64_t, std::vector<Extra>> origins{};  // of commands that say one
        std::map<std::uint64_t, OutsideCommand> skips{};        // refused; the loop is to be told
        bool isLost = false;
        bool isWholeStart = true;  // false: commands of it may have come before this was kept
    };
    struct Refusal {
        Outcome outcome;
        Reason reason;
        std::string why;
    };
    bool believable(const Command& command);                // its names and numbers fit together
    bool remember(const Sender& sender, std::int64_t now);  // false: there are too many senders
    bool forgetOneLost();                                   // false: none is lost
    bool reportLost(const Sender& sender);                  // false: the loop has no room for it
    void refuse(const Command& command, const Refusal& refusal);
    // The loop accepts no more.
    void turnAway(const Command& command, const OutsideCommand& message, HeardSender& from);
    // Whether the loop was given this command: then it alone answers, and no repetition is refused.
    static bool isInLoop(const Command& command, const HeardSender& from);
    bool isOurs(const OutsideCommand& message, Refusal& refusal) const;  // no other agent owns it
    static void keepOrigin(const Command& command, OutsideCommand& message, HeardSender& from);
    void pass(const Command& command, const OutsideCommand& message,
              const std::vector<std::uint64_t>& record, HeardSender& from);
    bool isProven(const Command& command);
    void skip(const OutsideCommand& message, HeardSender& from);
    bool passSkips(HeardSender& from);  // false: the pipe is full
    bool permitted(const Command& command, const OutsideCommand& message,
                   const std::vector<std::uint64_t>& record, Refusal& refusal);
    bool encode(const Command& command, OutsideCommand& message, std::vector<std::uint64_t>& record,
                Refusal& refusal) const;
    Answer answerFor(const OutsideAnswer& answer) const;

    AgentSelf& self_;
    std::function<void(const Answer&)> send_;
    SecurityIdentity* identity_;
    const AgentRivals* rivals_;
    CommandPipe pipe_;
    SpscRing<Sender> lostSenders_;
    std::map<std::string, HeardSender> senders_;  // by name
    // The last command that was not permitted: its repetitions are not reported again.
    Id reportedLink_{};
    std::uint64_t reportedNumber_ = 0;
};

}  // namespace cortex::comms
