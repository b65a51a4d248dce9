// SPDX-License-Identifier: Apache-2.0
#include "cli/conform_plant.hpp"

#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/toolkit/classes.hpp"

#include "cli/conform_devices.hpp"
#include "cli/live_agent.hpp"

#include <chrono>

namespace cortex::test {

ConformPlant::ConformPlant()
    : plant_{{CORTEX_SOURCE_DIR "/tests/data/conform-rules.xml"},
             std::chrono::milliseconds{10},
             "bench"} {
    toolkit::addClasses(plant_.classes());
    addConformDevices(plant_.classes());
    comms::NetworkOptions options;
    options.domain = std::stoi(domain);
    options.interfaces = {"127.0.0.1"};
    plant_.cluster().addInterface<comms::DdsInterface>(options);
}

ConformPlant::~ConformPlant() {
    ends_ = true;
    if (steps_.joinable()) steps_.join();
}

void ConformPlant::addAxis(const std::string& path, const std::string& device,
                           const std::string& mistake, const std::string& controller) {
    const std::string is = path + "/is", wish = path + "/wish";
    const bool isSimulated = device == "SimulatedAxis";
    add(is, "ShortAxis");
    add(wish, "ShortAxis");
    cs::TestPlant::Pairs settings;
    if (!mistake.empty()) settings.emplace_back("mistake", mistake);
    add(path, device,
        {{isSimulated ? "demand" : "demands", wish},
         {isSimulated ? "observation" : "observations", is}},
        settings);
    if (!controller.empty()) add(path + "/move", controller, {{"axes", is}, {"demands", wish}});
}

void ConformPlant::addBus(const std::string& path, const std::string& mistake) {
    add(path + "/is", "DigitalIoConcept");
    add(path, "ScriptedBus", {{"observations", path + "/is"}}, {{"mistake", mistake}});
}

void ConformPlant::addDrive(const std::string& path, const std::string& type, bool needsHoming) {
    const std::string is = path + "/is", set = path + "/set", wish = path + "/wish";
    add(is, "Ds402RotaryObservation", {}, {{"homingNeeded", needsHoming ? "true" : "false"}});
    add(set, "Ds402RotaryModification");
    add(wish, "ShortAxis");
    add(path, type, {{"demands", set}, {"observations", is}});
    add(path + "/lead", "Ds402AxisProcessor",
        {{"drives", is}, {"demands", wish}, {"setpoints", set}});
    add(path + "/move", "AxisPoseController", {{"axes", is}, {"demands", wish}});
}

void ConformPlant::addGripper(const std::string& path) {
    const std::string is = path + "/is", set = path + "/set", wish = path + "/wish";
    add(is, "Ds402LinearObservation", {}, {{"homingNeeded", "false"}, {"ratedEffort", "200"}});
    add(set, "Ds402LinearModification");
    add(wish, "SlideGripperAxis");
    add(path, "Ds402SimulatedDrive", {{"demands", set}, {"observations", is}},
        {{"startPosition", "0.05 0"}});
    add(path + "/lead", "Ds402AxisProcessor",
        {{"drives", is}, {"demands", wish}, {"setpoints", set}});
    add(path + "/move", "GripperController", {{"axes", is}, {"demands", wish}});
}

void ConformPlant::setStops(const std::string& path, double least, double most) {
    live({"set", path, "stops=" + std::to_string(least) + " " + std::to_string(most) + " 0 0"});
}

void ConformPlant::start(std::chrono::microseconds rest) {
    plant_.start();
    steps_ = std::thread{[this, rest] {
        while (!ends_) {
            plant_.step();
            std::this_thread::sleep_for(rest);
        }
    }};
}

}  // namespace cortex::test
