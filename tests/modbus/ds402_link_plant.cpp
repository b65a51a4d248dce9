// SPDX-License-Identifier: Apache-2.0
#include "modbus/ds402_link_plant.hpp"

#include "cortex/toolkit/classes.hpp"

#include "drive/ds402_modbus_drive.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::modbus::test {
namespace {

constexpr double stepOfDemand = 0.0002;  // rad in a cycle

}  // namespace

Ds402LinkPlant::Ds402LinkPlant(const SimProcess& sim, const LinkPlantOptions& options)
    : LinkPlant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
                 CORTEX_SOURCE_DIR "/tests/data/limited-axes.xml"},
                "/drive",
                "/drive/a"} {
    toolkit::addClasses(classes());
    classes().add<Ds402ModbusDrive>("Ds402ModbusDrive");
    Pairs observation{{"homingNeeded", "false"}},
        drive = linkSettings(sim.address(), {{"watchdogTime", "5"}});
    replace(observation, options.observation);
    replace(drive, options.device);
    Pairs processor, device;
    for (const std::string name : {"a", "b"}) {
        add("/drive/" + name, "Ds402RotaryObservation", {}, observation);
        add("/set/" + name, "Ds402RotaryModification");
        add("/demand/" + name, "LimitedAxis");
        processor.insert(processor.end(), {{"drives", "/drive/" + name},
                                           {"demands", "/demand/" + name},
                                           {"setpoints", "/set/" + name}});
        device.insert(device.end(),
                      {{"demands", "/set/" + name}, {"observations", "/drive/" + name}});
    }
    add("/drive", "Ds402ModbusDrive", device, drive);
    if (options.hasProcessor) add("/processor", "Ds402AxisProcessor", processor);
}

void Ds402LinkPlant::makeActive() {
    stepUntil("a present answer", [&] { return quality() == Quality::Good; });
    stepUntil("an active processor", [&] {
        const State now = state("/processor");
        if (now == State::Fault) cluster().send("/processor", "clearFaults");
        if (now == State::Standby) {
            tree().at("/demand/a").data<double>("position") = position();
            cluster().send("/processor", "startup");
        }
        return now == State::Active;
    });
}

void Ds402LinkPlant::moveTo(double wanted) {
    Data<double> demand = tree().at("/demand/a").data<double>("position");
    stepUntil("a position of " + std::to_string(wanted), [&] {
        if (state("/processor") != State::Active) makeActive();
        demand = demand + std::clamp(wanted - demand, -stepOfDemand, stepOfDemand);
        return std::abs(position() - wanted) < 1e-3;
    });
}

}  // namespace cortex::modbus::test
