// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "wire/messages.hpp"

#include <map>
#include <memory>
#include <string>

namespace cortex::comms {

// Sends each answer on the topic of its sender, one of sixteen that senders share. A writer is made
// when its topic is first needed, and kept: each endpoint that goes leaves a hole in what
// others must be told when they join, so they would wait the longer the more senders there were.
// Communication thread only.
class AgentAnswers {
public:
    explicit AgentAnswers(Participant& participant) : participant_{participant} {}

    // The first answer may come before its receiver is ready, who then sends the command again.
    // Throws Error.
    void send(const Answer& answer);

    // Makes the writer for a sender that has said that it may command, so that its first answer is
    // as quick as the next ones. Throws Error.
    void prepare(const std::string& sender) { (void)writerTo(sender); }

    void renew() { writers_.clear(); }  // before its participant is replaced

private:
    Writer<Answer>& writerTo(const std::string& sender);

    Participant& participant_;
    std::map<std::string, std::unique_ptr<Writer<Answer>>> writers_;  // by topic
};

}  // namespace cortex::comms
