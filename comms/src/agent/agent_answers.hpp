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

// Answers go to who sent the command and to nobody else: each sender has a topic of its own, which
// is written once it has commanded, and until a minute after it was known the last time; then what
// it missed while it was cut off has reached it. Communication thread. Times are steadyNow().
class AgentAnswers {
public:
    explicit AgentAnswers(Participant& participant) : participant_{participant} {}

    // The first may come too early for its receiver, who then sends his command again. False: too
    // many new senders command at a time. Throws Error.
    bool send(const Answer& answer, std::int64_t now);
    void keep(const std::function<bool(const std::string&)>& isKnown, std::int64_t now);

private:
    struct Way {
        std::unique_ptr<Writer<Answer>> writer;
        std::int64_t used = 0;
    };
    bool makeRoom(std::int64_t now);

    Participant& participant_;
    std::map<std::string, Way> ways_;  // by sender
};

}  // namespace cortex::comms
