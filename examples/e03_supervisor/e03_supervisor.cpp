// SPDX-License-Identifier: Apache-2.0
// Three agents on a network: `e03_supervisor left` and `e03_supervisor right` have an axis each,
// and `e03_supervisor supervisor` starts both, or none: stop one of the two, and it stops the
// other.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace cortex;

class Sine final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override { position_ = output("axis").data<double>("position"); }
    void stateActive(const Tick& tick) override { position_ = std::sin(3 * tick.seconds()); }
    Data<double> position_;
};

class Supervisor final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    struct Watched {
        const SlotState* slot;  // its quality is lost while its agent is not heard
        LifeCycleSender sender;
        bool heard() const { return slot->quality != Quality::Lost; }
    };
    void populate() override {
        for (const InputSimplex& each : inputs("watched"))
            watched_.push_back({&each.state(), lifeCycle(each)});
    }
    void stateActive(const Tick&) override {
        bring(std::ranges::all_of(watched_, &Watched::heard) ? State::Active : State::Standby);
    }
    bool stateShuttingDown(const Tick&) override { return bring(State::Standby); }
    // True: all that are heard are there. One that has its answer yet to come is not asked again.
    bool bring(State wanted) {
        bool there = true;
        for (Watched& each : watched_) {
            const State state = each.sender.state();
            if (!each.heard() || state == wanted) continue;
            there = false;
            if (state == State::Standby) each.sender.startup();
            if (state == State::Active) each.sender.shutdown();
        }
        return there;
    }
    std::vector<Watched> watched_;
};

int main(int argc, char** argv) {
    const std::string role = argc > 1 ? argv[1] : "";
    if (role != "left" && role != "right" && role != "supervisor") {
        std::cerr << "usage: e03_supervisor left|right|supervisor\n";
        return 2;
    }
    SimplexTree tree{TypeModel::load(SUPERVISOR_TYPES)};
    if (role == "supervisor") {
        auto& both = tree.add<Supervisor>("/supervisor/both", "Supervisor");
        tree.relateRemote(both, "watched", "/left/sine", "SineController");
        tree.relateRemote(both, "watched", "/right/sine", "SineController");
    } else {
        auto& axis = tree.add("/" + role + "/axis", "VirtualAxis");
        tree.relate(tree.add<Sine>("/" + role + "/sine", "SineController"), "axis", axis);
    }
    cs::blockStopSignals();
    cs::ClusterCS cluster{role, {.threads = 1}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{1});
    cluster.addInterface<comms::DdsInterface>();
    cluster.start();
    bool started = role != "supervisor";  // which starts when it hears both
    while (!cs::waitForInterrupt(0.1)) {
        started = started || cluster.call("/supervisor/both", "startup").done();
    }
}
