// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"

#include "determinism/behaviour.hpp"
#include "determinism/plan.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace cortex::determinism {

// What differs from run to run: how long things take, and who executed what.
struct Disturbance {
    std::uint64_t seed = 0;  // of the delays; 0: none
    // The thread on which each simplex of the plan last sent a command; commands executed, in all
    // and on another thread than that.
    std::array<std::atomic<int>, mostSimplexes> sentOn{};
    std::atomic<std::uint64_t> executed{0}, across{0};
};

// A task of a random system: binds the behaviour to the handles of the framework.
class RandomTask : public cs::SimplexCS {
public:
    RandomTask(Identity identity, const Plan& plan, std::size_t index, Disturbance& disturbance);

    void bind() { populate(); }  // for a loop that is put together by hand

protected:
    void populate() override;
    void loopStart(const Tick& tick) override;
    void stateStandby(const Tick&) override;
    bool stateStartingUp(const Tick&) override;
    void stateActive(const Tick& tick) override;
    bool stateShuttingDown(const Tick&) override;
    bool stateFault(const Tick&) override;
    void loopEnd(const Tick& tick) override;

private:
    struct Sender {
        CommandSender sender;
        Data<double> amount;
        Data<std::int64_t> number;
        Data<const double> sum;
        bool isSet = false;
    };
    struct Bound {  // a command and its parameters
        RandomTask* task;
        std::string command;
        Argument<double> amount;
        Argument<std::int64_t> number;
        Result<double> sum;
    };
    void bindRelations();
    void bindSenders();
    void bindOwn();
    InputPort inputPort(const InputSimplex& input);
    OutputPort outputPort(const OutputSimplex& output);
    template <class Related>
    void addSender(const Related& related, const SenderPlan& plan);
    int handOver(std::uint64_t wanted, const Tick& tick);
    void handleAll(std::string_view command);
    Reply execute(const Bound& bound, Call& call);
    void delay();

    std::size_t index_;
    const SimplexPlan& self_;
    Disturbance& disturbance_;
    Chance delays_;
    Behaviour behaviour_;
    World world_;
    std::deque<Sender> senders_;
    std::deque<LifeCycleSender> lives_;
    std::vector<LifeCycleSender> choices_;
    std::deque<Bound> handlers_;
    std::vector<std::span<std::int64_t>> loads_;  // measured items: may say what they like
    Data<std::string_view> words_;
};

}  // namespace cortex::determinism
