// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/probe.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::test {

// What a device saw of its demand in one cycle.
struct Seen {
    double position, velocity, current;
    SlotState state;
    bool lost;
};

// A sensor, a controller that needs it (onLoss="safe", or as the rule says) and a drive: demand /d
// has an item of each kind of safe value. With a second writer that never starts, if it is shared.
struct SafePlant {
    ProbeCluster cluster;
    Probe& sensor = cluster.probe("/sensor");
    Probe& controller = cluster.probe("/ctl");
    Probe& drive = cluster.tree.add<Probe>("/drive", "Probe");
    Data<double> demandedPosition, demandedVelocity, demandedCurrent, observation;
    double position = 0.25, velocity = 1, current = 7;  // what the controller writes in Active
    double observed = 0.25;                             // what the drive measures
    bool faults = false, lost = false;
    std::vector<Seen> seen;

    explicit SafePlant(bool shared = false, const char* rule = "guarded",
                       const cs::ClusterOptions& options = {});
    void start();
    void startUp();  // sensor and controller
    void write(double newPosition, double newVelocity, double newCurrent);
    std::size_t events(const std::string& text);  // so far that contain it
    std::string pathOf(std::uint32_t simplex);    // or "none"
};

}  // namespace cortex::test
