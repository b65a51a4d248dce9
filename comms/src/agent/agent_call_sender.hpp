// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command_exchange.hpp"

#include "agent/agent_links.hpp"
#include "agent/agent_peers.hpp"
#include "agent/agent_self.hpp"
#include "dds/participant.hpp"
#include "peers/sent_commands.hpp"
#include "wire/messages.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cortex::comms {

// Sends the commands of this agent's tasks to the agents whose simplexes it links, and passes their
// answers to the loop. A command has a second to arrive. The loop calls read() and write(); the
// communication thread calls the rest.
class AgentCallSender {
public:
    AgentCallSender(AgentSelf& self, const AgentLinks& links, Participant& participant);

    // Whether a task may send to another agent.
    bool any() const { return self_.access.calls > 0; }
    void leave() { out_.reset(); }  // before its participant is replaced
    void join();                    // after that
    void take(const Answer& answer) { sent_.take(answer); }
    // Sends what the loop has given and what is due again. While this agent is silent it sends
    // nothing.
    void step(const Peers& peers, bool silent);

    void read(Inbox& inbox) CORTEX_REALTIME { pipe_.read(inbox); }
    bool write(Outbox& outbox) CORTEX_REALTIME { return pipe_.write(outbox); }

private:
    struct Open {
        AgentCall call;
        std::uint64_t number;  // by which its answer is found
        std::string agent;
        std::int64_t epoch;  // of that agent
        bool running = false;
    };
    // One that stops something, and waits for room in the window.
    struct Held {
        AgentCall call;
        std::vector<std::byte> request;
        Moment end;
    };
    struct Tables {
        std::shared_ptr<const Structure> structure;
        std::unique_ptr<CommandTables> tables;
    };
    void send(const AgentCall& call, const Peers& peers, bool silent, Moment end);
    void sendHeld(const Peers& peers, bool silent, Moment now);
    void loseThoseOf(const Peers& peers);
    void passAnswers();
    const CommandTables& tablesOf(const AgentLinks::OwnerOf& owner);

    AgentSelf& self_;
    const AgentLinks& links_;
    Participant& participant_;
    AgentCallPipe pipe_;
    SentCommands sent_;
    std::unique_ptr<Writer<Command>> out_;
    std::vector<Open> open_;
    std::vector<Held> held_;
    std::map<std::string, Tables> tables_;  // by agent
};

}  // namespace cortex::comms
