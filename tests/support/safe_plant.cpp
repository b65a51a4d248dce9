// SPDX-License-Identifier: Apache-2.0
#include "support/safe_plant.hpp"

#include <algorithm>

namespace cortex::test {

SafePlant::SafePlant(bool shared, const char* rule, const cs::ClusterOptions& options)
    : cluster{options} {
    Simplex& demand = cluster.tree.add("/d", shared ? "SharedDemand" : "Demand");
    Simplex& seenByDrive = cluster.tree.add("/o", "Observation");
    seenByDrive.set("position", 0.25);
    Simplex& signal = cluster.tree.add("/s", "Signal");
    cluster.tree.relate(sensor, "out", signal);
    cluster.tree.relate(controller, rule, signal);
    cluster.tree.relate(controller, "observed", seenByDrive);
    cluster.tree.relate(controller, "demand", demand);
    if (shared) {
        Probe& other = cluster.probe("/other");
        cluster.tree.relate(other, "observed", seenByDrive);
        cluster.tree.relate(other, "demand", demand);
    }
    cluster.tree.relate(drive, "in", demand);
    cluster.tree.relate(drive, "out", seenByDrive, true);
    sensor.onLoopEnd = [this](Probe& self, const Tick&) {
        if (self.state() == State::Active && lost) self.setQuality(Quality::Lost);
    };
    controller.onPopulate = [this](Probe& self) {
        demandedPosition = self.output("demand").data<double>("position");
        demandedVelocity = self.output("demand").data<double>("velocity");
        demandedCurrent = self.output("demand").data<double>("current");
    };
    controller.onActive = [this](Probe& self, const Tick&) {
        write(position, velocity, current);
        if (faults) self.fault(3, "asked for");
    };
    drive.onPopulate = [this](Probe& self) {
        const auto in = self.input("in");
        observation = self.output("out").data<double>("position");
        self.onLoopEnd = [this, in, at = in.data<double>("position"),
                          speed = in.data<double>("velocity"),
                          strength = in.data<double>("current")](Probe& drives, const Tick&) {
            seen.push_back({at, speed, strength, in.state(), drives.inputLost()});
            observation = observed;
            drives.setQuality(Quality::Good);
        };
    };
}

void SafePlant::start() {
    cluster.start();
    cluster.step(5);
}

void SafePlant::startUp() {
    cluster.startup(sensor);
    cluster.startup(controller);
    cluster.step(5);
}

void SafePlant::write(double newPosition, double newVelocity, double newCurrent) {
    demandedPosition = newPosition;
    demandedVelocity = newVelocity;
    demandedCurrent = newCurrent;
}

std::size_t SafePlant::events(const std::string& text) {
    const auto has = [&](const std::string& event) {
        return event.find(text) != std::string::npos;
    };
    return static_cast<std::size_t>(std::ranges::count_if(cluster.events(), has));
}

std::string SafePlant::pathOf(std::uint32_t simplex) {
    if (simplex == noSimplex) return "none";
    return cluster.cluster->image().structure().simplexes[simplex].path;
}

}  // namespace cortex::test
