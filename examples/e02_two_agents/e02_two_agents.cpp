// SPDX-License-Identifier: Apache-2.0
// Two agents on a network: `e02_two_agents mover` moves an axis, `e02_two_agents follower` follows
// it with one of its own. Start them in any order, on one host or two; stop the mover, and the
// follower holds.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <cmath>
#include <iostream>
#include <string_view>

using namespace cortex;

class Sine final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override { position_ = output("axis").data<double>("position"); }
    void stateActive(const Tick& tick) override { position_ = std::sin(3 * tick.seconds()); }
    Data<double> position_;
};

class Follow final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        observed_ = input("observed").data<double>("position");
        position_ = output("axis").data<double>("position");
    }
    void stateActive(const Tick&) override { position_ = observed_; }
    Data<const double> observed_;
    Data<double> position_;
};

int main(int argc, char** argv) {
    const std::string_view role = argc > 1 ? argv[1] : "";
    if (role != "mover" && role != "follower") {
        std::cerr << "usage: e02_two_agents mover|follower\n";
        return 2;
    }
    SimplexTree tree{TypeModel::load("robotics-morphology.xml")};
    if (role == "mover") {
        auto& axis = tree.add("/machine/axis", "VirtualAxis");
        tree.relate(tree.add<Sine>("/machine/sine", "SineController"), "axis", axis);
    } else {
        auto& axis = tree.add("/desk/axis", "VirtualAxis");
        auto& follow = tree.add<Follow>("/desk/follow", "SineController");
        // The axis of whichever agent has it, as soon as that agent appears.
        tree.relateRemote(follow, "observed", "/machine/axis", "VirtualAxis");
        tree.relate(follow, "axis", axis);
    }
    cs::blockStopSignals();
    cs::ClusterCS cluster{std::string{role}, {.threads = 1}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{1});
    cluster.addInterface<comms::DdsInterface>();  // the network, in one line
    cluster.start();
    cluster.call("/" + std::string{role}, "startup", {{"prefix", "/"}});
    const char* axis = role == "mover" ? "/machine/axis" : "/desk/axis";
    while (!cs::waitForInterrupt(0.1))
        std::cout << cluster.image().get<double>(axis, "position") << std::endl;
}
