// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/registry.hpp"
#include "cortex/cs/cluster_cs.hpp"
#include "cortex/mechanics/serial_chain.hpp"

#include "core/model_folder.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cortex::test {

inline constexpr std::size_t lbrAxes = 7;
using Axes = std::array<double, lbrAxes>;
using Replacements = std::vector<std::pair<std::string, std::string>>;

// The shipped system file of the case study, with each text replaced that is named, in a folder of
// its own that lives as long as this object. An ontology may be added to it.
class TeleopFile {
public:
    explicit TeleopFile(const Replacements& replacements = {}, const std::string& ontology = "");

    std::filesystem::path path() const { return folder_.path() / "system.xml"; }

private:
    ModelFolder folder_;
};

// The case study at 1 kHz on a manual trigger. `watch` runs on the loop's thread after each cycle.
class Teleop {
public:
    struct Set {
        Replacements replacements;
        std::string ontology;  // types of the test
        std::function<void(ClassRegistry&)> classes;
        std::function<void(SimplexTree&)> change;
        cs::ClusterOptions options;
        std::function<void(const Image&)> watch;
    };

    Teleop() : Teleop{Set{}} {}
    explicit Teleop(Set set);

    // Starts everything; the hand's path begins within some 30 cycles.
    void startUp();
    CallResult call(const std::string& path, const std::string& command, const std::string& prefix);
    void step(std::int64_t cycles = 1) { trigger->step(cycles); }
    void runUntil(double pathTime);  // s of the hand's path

    Image image() { return cluster->image(); }
    double pathTime() { return image().get<double>("/playback", "time"); }

    ClassRegistry registry;
    TeleopFile file;
    SimplexTree tree;
    std::unique_ptr<cs::ClusterCS> cluster;
    cs::ManualTrigger* trigger = nullptr;
};

Axes positionsOf(const Image& image, const std::string& group);  // "axes" or "demands"
mechanics::Pose handOf(const Image& image);
State stateOf(const Image& image, const std::string& path);
bool pressed(const Image& image);

// What the example promises, measured from outside: tip by the data sheet's own kinematics from the
// observed axes, against the hand in the same cycle, both since the press, while follow is Active.
struct Tracking {
    double rmsPosition = 0;  // mm
    double rmsRotation = 0;  // degrees
    double rmsSpeed = 0;     // m/s
    double seconds = 0;
    bool keepsPromise() const { return seconds > 5 && rmsPosition < 2 && rmsRotation < 1; }
};
Tracking track(Teleop& teleop, double untilPathTime);

}  // namespace cortex::test
