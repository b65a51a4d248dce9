// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/core/command_exchange.hpp"

#include "mirror/mirror_agents.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace cortex::comms {

// The commands of a tool and their answers. A command is sent again, unchanged, until it is
// answered: agents recognise its number and execute it once. Used under the mutex of the mirror.
class MirrorCommands {
public:
    using Write = std::function<bool(const Command&)>;

    explicit MirrorCommands(const Sender& sender) : sender_{sender} {}

    // Throws Error as Mirror::send().
    std::uint64_t send(MirrorAgent& agent, std::string_view path, std::string_view command,
                       const CommandClient::Arguments& arguments, std::chrono::nanoseconds budget,
                       Moment now);
    bool poll(std::uint64_t number, CommandAnswer& answer);
    void abandon(std::uint64_t number);

    void take(const Answer& answer);
    void tick(Moment now, const Write& write);  // sends what is due, ends what is overdue
    void lose(const std::string& agent, const char* why);

    bool waiting() const;  // for an answer
    std::uint64_t refused() const { return refused_; }

private:
    struct Pending {
        Command message;
        Moment next, end;
        std::chrono::milliseconds pause{5};
        bool running = false;
    };
    struct Target {
        explicit Target(const Sender& sender) : client{sender} {}
        CommandClient client;
        std::map<std::uint64_t, Pending> pending;                     // by sequence
        std::map<std::uint64_t, std::chrono::nanoseconds> latencies;  // of answers not yet fetched
    };
    struct Number {
        std::string agent;
        std::uint64_t sequence;
    };

    Sender sender_;
    std::map<std::string, Target> targets_;
    std::map<std::uint64_t, Number> numbers_;
    std::uint64_t next_ = 1;
    std::uint64_t refused_ = 0;
};

}  // namespace cortex::comms
