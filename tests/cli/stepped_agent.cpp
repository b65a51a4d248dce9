// SPDX-License-Identifier: Apache-2.0
#include "cli/stepped_agent.hpp"

#include "cortex/comms/dds_interface.hpp"

#include "support/probe.hpp"

namespace cortex::test {

struct SteppedRobot::Implementation {
    ProbeCluster cluster{{}, "robot"};
    Data<std::int64_t> count;
};

SteppedRobot::SteppedRobot(int domain) : implementation_{std::make_unique<Implementation>()} {
    Implementation& self = *implementation_;
    comms::NetworkOptions options;
    options.domain = domain;
    options.interfaces = {"127.0.0.1"};
    self.cluster.cluster->addInterface<comms::DdsInterface>(options);
    Simplex& signal = self.cluster.tree.add("/signal", "Signal");
    Probe& probe = self.cluster.probe("/ctl");
    probe.onPopulate = [&self](Probe& of) {
        self.count = of.output("out").data<std::int64_t>("count");
    };
    probe.onActive = [&self](Probe& /*of*/, const Tick& tick) { self.count = tick.cycle; };
    self.cluster.tree.relate(probe, "out", signal);
    self.cluster.start();
    self.cluster.startup(probe);
}

SteppedRobot::~SteppedRobot() = default;

void SteppedRobot::step(std::int64_t cycles) { implementation_->cluster.step(cycles); }

std::int64_t SteppedRobot::cycle() const {
    return implementation_->cluster.cluster->image().cycle();
}

}  // namespace cortex::test
