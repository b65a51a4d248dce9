// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/cluster_cs.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::test {

// An active simplex whose hooks are functions of the test, all optional.
class Probe : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    using Hook = std::function<void(Probe&, const Tick&)>;
    using Condition = std::function<bool(Probe&, const Tick&)>;

    std::function<void(Probe&)> onPopulate;
    Hook onLoopStart, onStandby, onActive, onLoopEnd;
    Condition onStartingUp, onShuttingDown, onFault;
    std::function<cortex::Outcome(Probe&, Call&)> onAdd, onPoke, onWork;
    std::function<void(Probe&, ProposedSettings&)> onProposed;
    std::function<void(Probe&)> onChanged;
    std::function<void(Archive&)> onKeep;

    using SimplexCS::event;
    using SimplexCS::fault;
    using SimplexCS::HandOver;
    using SimplexCS::input;
    using SimplexCS::inputLost;
    using SimplexCS::inputs;
    using SimplexCS::lifeCycle;
    using SimplexCS::LifeCycleSender;
    using SimplexCS::output;
    using SimplexCS::outputs;
    using SimplexCS::runtime;
    using SimplexCS::setQuality;

    // Before what the hooks refer to is gone.
    void forgetHooks();

    Argument<double> amount;
    Result<double> sum;

protected:
    void populate() override;
    void loopStart(const Tick& tick) override { run(onLoopStart, tick); }
    void stateStandby(const Tick& tick) override { run(onStandby, tick); }
    bool stateStartingUp(const Tick& tick) override { return ask(onStartingUp, tick); }
    void stateActive(const Tick& tick) override { run(onActive, tick); }
    bool stateShuttingDown(const Tick& tick) override { return ask(onShuttingDown, tick); }
    bool stateFault(const Tick& tick) override { return ask(onFault, tick); }
    void loopEnd(const Tick& tick) override { run(onLoopEnd, tick); }
    void settingsProposed(ProposedSettings& proposed) override {
        if (onProposed) onProposed(*this, proposed);
    }
    void settingsChanged() override {
        if (onChanged) onChanged(*this);
    }
    void keep(Archive& archive) override {
        if (onKeep) onKeep(archive);
    }

private:
    void run(const Hook& hook, const Tick& tick) {
        if (hook) hook(*this, tick);
    }
    bool ask(const Condition& condition, const Tick& tick) {
        return !condition || condition(*this, tick);
    }
    cortex::Outcome add(Call& call) { return onAdd ? onAdd(*this, call) : cortex::Outcome::Done; }
    cortex::Outcome poke(Call& call) {
        return onPoke ? onPoke(*this, call) : cortex::Outcome::Done;
    }
    cortex::Outcome work(Call& call) {
        return onWork ? onWork(*this, call) : cortex::Outcome::Done;
    }
};

// Its end calls no hooks of probes: what they refer to may be gone by then.
// A cluster on a manual trigger of 1 kHz with the types of tests/data/cs-rules.xml.
class ProbeCluster {
public:
    explicit ProbeCluster(cs::ClusterOptions options = {}, const std::string& name = "test");
    ~ProbeCluster();
    ProbeCluster(const ProbeCluster&) = delete;
    ProbeCluster& operator=(const ProbeCluster&) = delete;

    Probe& probe(std::string_view path, std::string_view type = "Probe") {
        return tree.add<Probe>(path, type);
    }
    void start();
    void step(std::int64_t cycles = 1) { trigger->step(cycles); }
    // Sends and steps until the answer is there (at most 100 cycles).
    CallResult call(std::string_view path, std::string_view command,
                    const ProgramInterface::Arguments& arguments = {});
    void startup(Probe& probe);  // steps until it is Active
    double number(std::string_view path, std::string_view item);
    std::int64_t integer(std::string_view path, std::string_view item);
    State state(std::string_view path);
    Quality quality(std::string_view path);
    // All events so far, as "path: text".
    std::vector<std::string> events();
    bool hasEvent(std::string_view text);

    SimplexTree tree;
    std::unique_ptr<cs::ClusterCS> cluster;
    cs::ManualTrigger* trigger = nullptr;

private:
    std::vector<std::string> events_;
};

}  // namespace cortex::test
