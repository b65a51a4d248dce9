// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command_exchange.hpp"

#include "peers/moment.hpp"
#include "peers/peer_model.hpp"
#include "wire/messages.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace cortex::comms {

// An agent as a command to it needs to know it, at this moment.
struct CommandTarget {
    const PeerModel& model;
    const CommandTables& tables;
    std::int64_t cycle;  // the newest that is known
    Moment heard;        // last
    std::int64_t clock;  // its own, ns, when its last presence came; 0: it tells none
    Moment clockHeard;
    bool lost;
};

// The commands of one sender, a tool or an agent, and their answers. A command is sent again,
// unchanged, until it is answered: agents recognise its number and execute it once. The oldest one
// without an answer is sent most often, because agents let later ones wait for it. One that runs is
// sent slowly, until its end is known. One thread at a time.
class SentCommands {
public:
    using Write = std::function<bool(const Command&)>;

    explicit SentCommands(const Sender& sender) : sender_{sender} {}

    // `budget`: how long it may take to arrive. Throws Error as CommandClient::prepare().
    std::uint64_t send(const CommandTarget& agent, std::string_view path, std::string_view command,
                       const CommandClient::Arguments& arguments, std::chrono::nanoseconds budget,
                       Moment now);
    bool hasRoom(const std::string& agent, std::string_view command) const;  // for one more
    void actFor(std::string person) { onBehalfOf_ = std::move(person); }     // empty: for itself
    // `latency`: in the agent that executed it.
    bool poll(std::uint64_t number, CallResult& answer,
              std::chrono::nanoseconds* latency = nullptr);
    bool running(std::uint64_t number) const;  // it was answered, but not for the last time
    void abandon(std::uint64_t number);

    void take(const Answer& answer);
    void tick(Moment now, const Write& write);  // sends what is due, ends what is overdue
    void lose(const std::string& agent, const std::string& why);

    bool waiting() const;  // for an answer
    std::uint64_t refused() const { return refused_; }

private:
    struct Pending {
        Command message;
        Moment next, end, written;
        std::chrono::milliseconds pause{5};
        bool running = false;
        bool oldest = false;  // of those without an answer

        void becomeOldest();
        void run();
        std::chrono::milliseconds longestPause() const;
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

    static void tick(Target& target, Moment now, const Write& write);

    Sender sender_;
    std::string onBehalfOf_;
    std::map<std::string, Target> targets_;
    std::map<std::uint64_t, Number> numbers_;
    std::uint64_t next_ = 1;
    std::uint64_t refused_ = 0;
};

}  // namespace cortex::comms
