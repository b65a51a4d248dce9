// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "peers/sent_commands.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

// The commands of several senders to one agent, through a network that loses, copies and delays
// them, with senders and agents that are killed, stand still and have wrong clocks. A step is one
// cycle of 1 ms; the seed decides everything.
namespace cortex::comms {

struct Faults {
    double loss = 0, copies = 0, late = 0;                  // shares of the samples
    std::int64_t latest = 5;                                // steps that a late one takes longer
    double rate = 0.2;                                      // commands in a step, of each sender
    double killed = 0, cut = 0;                             // senders, in a step
    double agentKilled = 0, stands = 0;                     // the agent, its loop
    double stops = 0, wide = 0, refused = 0, notHeard = 0;  // shares of the commands
    double takesLong = 0;                                   // as well
    bool shortBudgets = false, wrongClocks = false;
    std::uint32_t room = 256;
};

Faults chaos(std::uint64_t seed);

struct Plant;

// One command, as it truly is.
struct Truth {
    std::size_t sender = 0, simplex = 0;
    std::int64_t start = 0, notAfter = 0, came = -1;
    std::uint64_t sequence = 0;  // 0: not sent
    bool lifeCycle = false, refused = false, begun = false;
    Outcome outcome = Outcome::None;
    bool isLong = false, ran = false;  // its sender knows that it runs
    Outcome end = Outcome::None;       // of a long one
};

struct Counts {
    int twice = 0, disorder = 0, late = 0, lies = 0, gaps = 0, unanswered = 0, longWaits = 0;
    int sent = 0, begun = 0, expired = 0, waits = 0;
    int ended = 0, forgotten = 0;  // long ones that ran
    std::string lie;               // the last

    int wrong() const {
        return twice + disorder + late + lies + gaps + unanswered + longWaits + forgotten;
    }
    std::string text() const {
        const auto put = [](const char* name, int count) {
            return std::string{name} + " " + std::to_string(count) + ", ";
        };
        return put("twice", twice) + put("out of order", disorder) + put("late", late) +
               put("lies", lies) + put("gaps", gaps) + put("unanswered", unanswered) +
               put("waits too long", longWaits) + put("sent", sent) + put("begun", begun) +
               put("expired", expired) + put("waits", waits) + put("ended", ended) +
               put("forgotten", forgotten) + lie;
    }
};

class Simulation {
public:
    Simulation(std::uint64_t seed, const Faults& faults);
    Counts run(std::int64_t steps);

private:
    struct Station {  // a sender
        std::int64_t start = 0, epoch = 0, asleepUntil = 0, cutUntil = 0;
        std::unique_ptr<SentCommands> commands;
        std::shared_ptr<Plant> target;  // the start of the agent that it knows
        std::vector<std::pair<std::uint64_t, std::size_t>> open;  // number and truth
        // Of each simplex, the start and the number of the last that began.
        std::array<std::pair<std::int64_t, std::uint64_t>, 5> newest{};
    };
    struct Packet {
        std::int64_t at = 0, tie = 0;
        std::size_t sender = 0;
        std::optional<Command> command;
        std::optional<Answer> answer;
        bool operator<(const Packet& other) const {
            return std::pair{at, tie} > std::pair{other.at, other.tie};
        }
    };

    int unanswered() const;
    bool happens(double share);
    std::int64_t between(std::int64_t low, std::int64_t high);
    std::int64_t clock() const { return 3'600'000'000'000 + now_ * 1'000'000; }
    Moment moment() const { return Moment{std::chrono::nanoseconds{clock()}}; }
    void startSender(std::size_t index);
    void startAgent();
    void step(bool faulty);
    void stepSender(std::size_t index, bool faulty);
    void stepAgent(bool faulty);
    void send(std::size_t index);
    bool clockWentBack(std::size_t index) const;
    void poll(std::size_t index);
    void judgeEnd(const Truth& truth, const CallResult& result);
    void write(std::size_t index, const Command& message);
    void put(Packet packet);
    void deliver(const Packet& packet);
    void takeAnswer(const Answer& answer);
    void begin(std::size_t id);
    void lie(const Truth& truth, const std::string& how);

    std::mt19937_64 random_;
    Faults faults_;
    bool faulty_ = true;
    std::int64_t now_ = 0, tie_ = 0, agentEpoch_ = 100, standsUntil_ = 0, downUntil_ = 0;
    std::shared_ptr<Plant> plant_;
    std::array<Station, 4> senders_;
    std::set<std::pair<std::size_t, std::int64_t>> epochs_;
    std::map<std::pair<std::size_t, std::int64_t>, std::vector<std::size_t>> sequences_;
    std::vector<Truth> truths_;
    std::vector<std::size_t> executed_;  // in this cycle
    std::priority_queue<Packet> network_;
    Counts counts_;
};

}  // namespace cortex::comms
