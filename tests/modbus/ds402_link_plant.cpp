// SPDX-License-Identifier: Apache-2.0
#include "modbus/ds402_link_plant.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/toolkit/classes.hpp"

#include "drive/ds402_modbus_drive.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace cortex::modbus::test {
namespace {

using namespace std::chrono_literals;

constexpr double stepOfDemand = 0.0002;  // rad in a cycle

}  // namespace

Ds402LinkPlant::Ds402LinkPlant(const SimProcess& sim, const LinkPlantOptions& options)
    : TestPlant{{CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
                 CORTEX_SOURCE_DIR "/tests/data/limited-axes.xml"},
                100us} {
    toolkit::addClasses(classes());
    classes().add<Ds402ModbusDrive>("Ds402ModbusDrive");
    Pairs observation{{"homingNeeded", "false"}},
        drive{{"address", sim.address()}, {"exchangePeriod", "0.001"}, {"responseTimeout", "0.6"},
              {"lossTime", "0.7"},        {"reconnectTime", "0.01"},   {"watchdogTime", "5"}};
    const auto replace = [](Pairs& all, const Pairs& given) {
        for (const auto& each : given) {
            std::erase_if(all, [&](const auto& one) { return one.first == each.first; });
            all.push_back(each);
        }
    };
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

void Ds402LinkPlant::start() {
    cluster().addEventSink([told = told_](const Event& event, const Structure&) {
        const std::lock_guard lock{told->mutex};
        told->text += std::string{event.text.view()} + "\n";
    });
    TestPlant::start();
}

std::int64_t Ds402LinkPlant::stepUntil(const std::string& what,
                                       const std::function<bool()>& condition) {
    const std::int64_t before = cycle();
    cortex::test::waitUntil(
        what,
        [&] {
            if (condition()) return true;
            step();
            return false;
        },
        [this] { return events(); });
    return cycle() - before;
}

void Ds402LinkPlant::stepWithExchanges(std::int64_t more) {
    const std::int64_t before = count("exchangeCount");
    stepUntil("exchanges", [&] { return count("exchangeCount") >= before + more; });
}

void Ds402LinkPlant::open() {
    start();
    stepUntil("a present answer", [&] { return quality() == Quality::Good; });
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

Quality Ds402LinkPlant::quality() {
    const Image image = cluster().image();
    return image.state(image.structure().find("/drive/a")).quality;
}

std::string Ds402LinkPlant::events() {
    cluster().agent().events().flush();
    const std::lock_guard lock{told_->mutex};
    return told_->text;
}

}  // namespace cortex::modbus::test
