// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "wire/messages.hpp"

#include <map>
#include <memory>
#include <string>

namespace cortex::comms {

// Sends each answer on the topic of its sender, one of sixteen that senders share. A writer is made
// with the first answer on its topic and kept: each endpoint that goes leaves a hole in what
// others must be told when they join, so they would wait the longer the more senders there were.
// Communication thread only.
class AgentAnswers {
public:
    explicit AgentAnswers(Participant& participant) : participant_{participant} {}

    // The first answer may come before its receiver is ready, who then sends the command again.
    // Throws Error.
    void send(const Answer& answer);

private:
    Participant& participant_;
    std::map<std::string, std::unique_ptr<Writer<Answer>>> writers_;  // by topic
};

}  // namespace cortex::comms
