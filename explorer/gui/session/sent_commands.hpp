// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::gui {

// What became of a command that was sent.
struct CommandOutcome {
    std::uint64_t number = 0;  // that Session::send() gave
    std::string path, command;
    comms::CommandAnswer answer;
    std::string problem;  // why it was never sent; otherwise empty
    std::int64_t came{};  // UTC ns, when the window took it; 0: not yet
};

struct CommandRequest {
    std::uint64_t number = 0;
    std::string path, command;
    comms::Mirror::Arguments arguments;
    std::chrono::milliseconds limit{}, budget{};
};

// That it was never sent.
CommandOutcome notSent(const CommandRequest& request, std::string problem);

// Sends commands and waits for their answers, at most until their limit, or until their agent is
// lost or has started anew. Session thread.
class SentCommands {
public:
    explicit SentCommands(comms::Mirror& mirror) : mirror_{mirror} {}

    // Each gives the outcomes that are known by now.
    std::vector<CommandOutcome> send(std::vector<CommandRequest> requests, const Frame& frame);
    std::vector<CommandOutcome> step(const Frame& frame);

private:
    struct Sent {
        CommandRequest request;
        std::uint64_t number = 0;  // the mirror's
        std::chrono::steady_clock::time_point since{};
        std::string agent{};  // that owned the path, and its start
        std::int64_t epoch = 0;
    };
    static bool isGone(const Sent& sent, const Frame& frame);

    comms::Mirror& mirror_;
    std::vector<Sent> unanswered_;
};

}  // namespace cortex::gui
