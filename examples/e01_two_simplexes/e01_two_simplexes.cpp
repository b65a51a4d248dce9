// SPDX-License-Identifier: Apache-2.0
// Two simplexes: a controller moves an axis back and forth at 1 kHz. The program prints the axis,
// and every tool on the network can watch it.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <cmath>
#include <iostream>

using namespace cortex;

class Sine final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {  // once, after the model was checked: may allocate, may throw
        amplitude_ = data<const double>("amplitude");
        position_ = output("axis").data<double>("position");
    }
    void stateActive(const Tick& tick) override {  // every cycle while Active: must do neither
        position_ = amplitude_ * std::sin(3 * tick.seconds());
    }
    Data<const double> amplitude_;
    Data<double> position_;
};

int main() {
    SimplexTree tree{TypeModel::load("robotics-morphology.xml")};
    auto& axis = tree.add("/arm/axis", "VirtualAxis");  // its type says which data it has
    auto& sine = tree.add<Sine>("/arm/sine", "SineController");
    tree.relate(sine, "axis", axis);
    cs::ClusterCS cluster{"plant", {.threads = 1}};
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{1});
    cluster.addInterface<comms::DdsInterface>();  // others on the network see it all
    cluster.start();  // throws ModelError, with every rule that the tree breaks
    cluster.call("/arm/sine", "startup");
    for (int i = 0; i < 20 && !cs::waitForInterrupt(0.1); ++i)
        std::cout << cluster.image().get<double>("/arm/axis", "position") << std::endl;
}  // ~ClusterCS shuts down, writes safe demands and ends the loop
