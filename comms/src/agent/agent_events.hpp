// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_self.hpp"
#include "wire/messages.hpp"

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace cortex::comms {

// Carries events from the agent's log to the communication thread. It is bounded and drops the
// oldest event first; the numbers show the gap. Any thread may use it. The sink may outlive the
// interface.
class AgentEvents {
public:
    // Adds a sink to the agent's log; before its start().
    explicit AgentEvents(const AgentSelf& self);
    ~AgentEvents();  // from here on the sink does nothing

    // Takes a few of the oldest events, since the thread has other things to do. False: more are
    // waiting.
    bool take(std::vector<EventMessage>& emptied);
    bool empty() const;

private:
    struct Queue {
        std::mutex mutex;
        std::deque<EventMessage> messages;
        bool open = true;
    };
    std::shared_ptr<Queue> queue_ = std::make_shared<Queue>();
};

}  // namespace cortex::comms
