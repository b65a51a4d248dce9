// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent_self.hpp"
#include "messages.hpp"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace cortex::comms {

// Events on their way from the agent's log to the communication thread; bounded, the oldest go
// first: the numbers show the gap. Any thread. The log's sink may outlive the interface.
class AgentEvents {
public:
    // Adds a sink to the agent's log; before its start().
    explicit AgentEvents(const AgentSelf& self);
    ~AgentEvents();  // from here on the sink does nothing

    void take(std::vector<EventMessage>& emptied);

private:
    struct Queue {
        std::mutex mutex;
        std::vector<EventMessage> messages;
        bool open = true;
    };
    std::shared_ptr<Queue> queue_ = std::make_shared<Queue>();
};

}  // namespace cortex::comms
