// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/quality.hpp"
#include "cortex/core/report.hpp"
#include "cortex/core/state.hpp"
#include "cortex/core/tick.hpp"

#include "determinism/plan.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cortex::determinism {

// What a task sees of the world, filled by the reference and by the real system, each in its way.
struct InputPort {
    std::vector<const double*> numbers;
    std::vector<const std::int64_t*> integers;
    std::vector<const bool*> flags;
    std::vector<std::function<std::string_view()>> texts;
    std::function<Quality()> quality;
    std::function<std::int64_t()> stamp;
};
struct OutputPort {
    std::vector<double*> numbers;
    std::vector<double> scales;  // of each number, see scaleOf()
    // Of a demand: as it went out in the cycle before.
    std::vector<std::function<double()>> accepted;
    std::vector<std::int64_t*> integers;
    std::vector<bool*> flags;
    std::vector<std::function<void(std::string_view)>> texts;
};
// Of what size the numbers are that a task writes: mostly valid ones.
inline double scaleOf(const DataItem& item) {
    return item.max ? std::visit([](auto max) { return static_cast<double>(max); }, *item.max) : 50;
}

struct SeenAnswer {
    Outcome outcome;
    Reason reason;
    std::uint64_t number, sent, answered;
    std::int64_t latencyCycles;
    std::string_view why;
    double sum;
};
struct SenderPort {
    std::function<Outcome(double amount, std::int64_t number)> send;
    std::function<SeenAnswer()> answer;
};
struct LifePort {
    std::function<State()> state;
    std::function<void(LifeCycle)> post;
};
// What a task hands demands over between: bit n of `wanted` is the n-th choice.
struct ExchangePort {
    std::size_t choices = 0;
    std::function<int(std::uint64_t wanted, const Tick& tick)> handOver;
};
struct World {
    std::size_t index = 0;  // in the plan
    std::vector<InputPort> inputs;
    std::vector<OutputPort> outputs;
    std::vector<SenderPort> senders;
    std::vector<LifePort> lives;
    ExchangePort exchange;
    double *result = nullptr, *gain = nullptr;
    std::int64_t *total = nullptr, *heard = nullptr, *choice = nullptr;
    double* progress = nullptr;  // of a LongTask
    std::function<void(std::string_view)> words;
    std::function<void(std::int64_t, std::string_view)> fault;
    std::function<void(Quality, std::int64_t)> setQuality;
    std::function<void(Severity, std::string_view)> event;
};

struct Request {
    std::string_view command;
    double amount;
    std::int64_t number;
    bool first = true, cancelling = false;
};
struct Reply {
    Outcome outcome = Outcome::Done;
    Reason reason = Reason::None;
    std::string_view why{};
    double sum = 0;
};

// What the user wrote: a function of its seed, the ticks and all that it sees. One object for each
// task and run; knows nothing of who executes it.
class Behaviour {
public:
    Behaviour(std::uint64_t seed, bool wild) : chance_{seed}, wild_{wild} {}

    void loopStart(World& world, const Tick& tick);
    void standby(World& world);
    bool startingUp(World& world);
    void active(World& world, const Tick& tick);
    bool shuttingDown(World& world);
    bool inFault(World& world);
    void loopEnd(World& world, const Tick& tick);
    Reply command(World& world, const Request& request);

private:
    void sense(World& world);
    void write(World& world);
    void writeNumber(double& number, double scale);
    void talk(World& world);
    void mayFail(World& world, std::uint64_t oneIn);
    Reply zap(World& world);
    Reply work(World& world, const Request& request);

    Chance chance_;
    bool wild_;
    int left_ = 0;              // calls of the long command
    std::uint64_t wanted_ = 1;  // of the choices
};

}  // namespace cortex::determinism
