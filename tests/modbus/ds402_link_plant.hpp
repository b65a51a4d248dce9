// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modbus/link_plant.hpp"
#include "modbus/sim_process.hpp"

#include <cstdint>

namespace cortex::modbus::test {

struct LinkPlantOptions {
    cs::TestPlant::Pairs device{};       // settings of /drive
    cs::TestPlant::Pairs observation{};  // of both observations
    bool hasProcessor = true;
};

// Two axes, their processor and a Ds402ModbusDrive before a real cortex-ds402-sim.
class Ds402LinkPlant : public LinkPlant {
public:
    explicit Ds402LinkPlant(const SimProcess& sim, const LinkPlantOptions& options = {});

    void makeActive();  // the processor, again after each fault: a busy machine may cause some
    // Moves the demand of axis 1, with an active processor.
    void moveTo(double position);

    double position() { return get<double>("/drive/a", "position"); }
    std::int64_t driveState() { return get<std::int64_t>("/drive/a", "driveState"); }
};

}  // namespace cortex::modbus::test
