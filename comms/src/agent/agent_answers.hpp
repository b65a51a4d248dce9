// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace cortex::comms {

// Sends each answer to the sender of its command and to nobody else: each sender has a topic of its
// own. The topic is written from the sender's first command until a minute after the sender was
// last known. So a sender that was cut off still receives what it missed. Communication thread
// only. Times are those of monotonicNow().
class AgentAnswers {
public:
    explicit AgentAnswers(Participant& participant) : participant_{participant} {}

    // The first answer may come before its receiver is ready, who then sends the command again.
    // False: too many new senders command at the same time. Throws Error.
    bool send(const Answer& answer, std::int64_t now);
    // Closes the topics of senders that have not been known for a minute.
    void keep(const std::function<bool(const std::string&)>& isKnown, std::int64_t now);

private:
    struct Way {
        std::unique_ptr<Writer<Answer>> writer;
        std::int64_t used = 0;  // ns, when its sender was last known
    };
    bool makeRoom(std::int64_t now);  // closes the topic that was unused for longest

    Participant& participant_;
    std::map<std::string, Way> ways_;  // by sender
};

}  // namespace cortex::comms
