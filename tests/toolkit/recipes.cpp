// SPDX-License-Identifier: Apache-2.0
#include "recipes.hpp"

#include "ds402_plant.hpp"
#include "mechanics/lbr_chain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cortex::toolkit::test {
namespace {

using mechanics::Pose;
using mechanics::SerialChain;
using mechanics::test::lbrChain;
using mechanics::test::lbrPosture;

void write(Rig& rig, const std::string& path, const std::string& item, double value) {
    rig.tree().at(path).data<double>(item) = value;
}

void press(Rig& rig, bool pressed) { rig.tree().at("/button").data<bool>("value") = pressed; }

void moveFrame(Rig& rig, const std::string& path, double angle) {
    const auto position = rig.tree().at(path).array<double>("position");
    const auto rotation = rig.tree().at(path).array<double>("rotation");
    const auto velocity = rig.tree().at(path).array<double>("linearVelocity");
    position[0] = 0.3 + 0.1 * std::sin(angle);
    position[2] = 0.5 + 0.1 * std::cos(angle);
    rotation[2] = std::sin(angle / 2);
    rotation[3] = std::cos(angle / 2);
    velocity[0] = 0.1 * std::cos(angle);
}

double angleAt(std::int64_t cycle, double past) {
    return static_cast<double>(cycle) * 1e-3 * (cycle < runUp ? past : 1.0);
}

// Hand and tip with a button that is pressed from cycle 60 on, at other poses in another past.
void buildHand(Rig& rig) {
    for (const char* path : {"/hand", "/tip"}) rig.add(path, "CartesianObservation");
    rig.add("/button", "DigitalIoConcept");
}

void feedHand(Rig& rig, std::int64_t cycle, double past) {
    moveFrame(rig, "/hand", angleAt(cycle, past));
    moveFrame(rig, "/tip", angleAt(cycle, past) / 2);
    press(rig, cycle > 60);
}

void buildAxes(Rig& rig, const std::string& type, const std::string& demandRule) {
    rig.add("/axis", "RotaryAxisObservation");
    rig.add("/demand", "RotaryAxisConcept");
    rig.add("/it", type, {{"axes", "/axis"}, {demandRule, "/demand"}});
}

void feedAxis(Rig& rig, std::int64_t cycle, double past) {
    write(rig, "/axis", "position", std::sin(angleAt(cycle, past) + past));
}

// To 0, and it is still on its way at the end.
void moveSlowly(Rig& rig, std::int64_t cycle) {
    if (cycle != runUp - 30) return;
    rig.cluster().send("/it", "set", {{"pose", std::vector<double>(16)}});
    rig.cluster().send("/it", "moveTo", {{"speedShare", 0.01}});
}

void buildChain(Rig& rig, const std::string& type, Rig::Pairs relates) {
    const char* directions[] = {"0 0 1", "0 1 0", "0 1 0"};
    for (int i = 0; i < 3; ++i) {
        const std::string path = "/axes/" + std::to_string(i);
        rig.add(path, "RotaryAxisObservation", {},
                {{"originPosition", "0 0 0.3"}, {"direction", directions[i]}});
        relates.emplace_back("axes", path);
    }
    rig.add("/it", type, relates, {{"tipPosition", "0 0 0.3"}});
}

void feedChain(Rig& rig, std::int64_t cycle, double past) {
    for (int i = 0; i < 3; ++i) {
        write(rig, "/axes/" + std::to_string(i), "position",
              0.3 + 0.02 * std::sin(angleAt(cycle, past) + i));
    }
}

// The tip moves in a way of its own in each past, and so the elbow is elsewhere in the end.
void feedInverse(Rig& rig, std::int64_t cycle, double past) {
    static const SerialChain chain = lbrChain();
    SerialChain::JointVector joints = lbrPosture();
    for (int i = 0; i < 7; ++i) {
        write(rig, "/lbr/axes/" + std::to_string(i + 1), "position", joints[i]);
        joints[i] += 0.1 * std::sin(angleAt(cycle, past) * (i + 1)) * past;
    }
    const Pose pose = chain.forward(joints);
    const auto position = rig.tree().at("/target").array<double>("position");
    const auto rotation = rig.tree().at("/target").array<double>("rotation");
    for (int i = 0; i < 3; ++i) position[static_cast<std::size_t>(i)] = pose.position[i];
    for (int i = 0; i < 4; ++i) rotation[static_cast<std::size_t>(i)] = pose.rotation.coeffs()[i];
}

void buildSine(Rig& rig, const std::string& name) {
    rig.add(name + "Axis", "VirtualAxis");
    rig.add(name, "SineController", {{"axis", name + "Axis"}});
}

void buildNumbers(Rig& rig) {
    rig.add("/number", "MeasuredTemperature");
    rig.add("/wish", "Temperature");
    rig.add("/heating", "Heating");
}

void feedNumber(Rig& rig, std::int64_t cycle, double past) {
    write(rig, "/number", "value", 100 * std::sin(angleAt(cycle, past)));
}

void feedNothing(Rig&, std::int64_t, double) {}

const std::vector<Recipe> allRecipes{
    // The axis is still on its slow way to the demand that it joined.
    {"Ds402AxisProcessor", true, [](Rig& rig) { buildDrives(rig, {}); },
     [](Rig& rig, std::int64_t cycle, double past) {
         write(rig, "/demand/a", "position", cycle < runUp ? 0.009 / past : 0.005);
     }},
    {"SimulatedSafetyPanel", true,
     [](Rig& rig) {
         rig.add("/safety", "SafetyStatus");
         rig.add("/it", "SimulatedSafetyPanel", {{"status", "/safety"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         if (cycle == runUp - 50 && past == 1) rig.cluster().send("/it", "press");
     }},
    {"ForwardKinematics", false, [](Rig& rig) { buildChain(rig, "ForwardKinematics", {}); },
     feedChain},
    {"InverseKinematics", true,
     [](Rig& rig) {
         rig.add("/lbr", "KukaLbr");
         rig.add("/target", "CartesianConcept");
         Rig::Pairs relates{{"target", "/target"}};
         for (int i = 1; i <= 7; ++i) {
             const std::string number = std::to_string(i);
             rig.add("/targets/" + number, "RotaryAxisConcept");
             relates.emplace_back("axes", "/lbr/axes/" + number);
             relates.emplace_back("targets", "/targets/" + number);
         }
         rig.add("/it", "InverseKinematics", relates);
     },
     feedInverse},
    // It brakes, as the jog that outranked it ends in motion.
    {"HoldAxisController", true,
     [](Rig& rig) {
         rig.add("/axis", "RotaryAxisObservation");
         rig.add("/demand", "RotaryAxisConcept");
         for (const auto& [path, type] :
              {std::pair{"/first", "JogController"}, std::pair{"/it", "HoldAxisController"}})
             rig.add(path, type, {{"axes", "/axis"}, {"demands", "/demand"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         if (cycle == runUp - 200) {
             rig.cluster().send("/first", "jog",
                                {{"axis", std::int64_t{1}}, {"velocity", 50 * past}});
         }
         if (cycle == runUp - 20) rig.cluster().send("/first", "shutdown");
     }},
    {"FollowAxisController", true,
     [](Rig& rig) {
         rig.add("/axis", "RotaryAxisObservation");
         rig.add("/demand", "LimitedAxis");
         rig.add("/target", "RotaryAxisConcept");
         rig.add("/it", "FollowAxisController",
                 {{"axes", "/axis"}, {"demands", "/demand"}, {"targets", "/target"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         write(rig, "/target", "position", angleAt(cycle, past));
     }},
    // Its target has jumped just now, by more in another past, and it is on its way there.
    {"InverseDynamics", true,
     [](Rig& rig) {
         rig.add("/axis", "RotaryAxisObservation", {}, {{"linkMass", "2"}});
         rig.add("/demand", "LimitedAxis");
         rig.add("/target", "RotaryAxisConcept");
         rig.add("/it", "InverseDynamics",
                 {{"axes", "/axis"}, {"demands", "/demand"}, {"targets", "/target"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         const double jump = cycle < runUp - 20 ? 0 : cycle < runUp ? 0.5 * past : 0.5;
         write(rig, "/target", "position", jump);
     }},
    {"AxisPoseController", true, [](Rig& rig) { buildAxes(rig, "AxisPoseController", "demands"); },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         moveSlowly(rig, cycle);
     }},
    {"JointTrajectoryController", true,
     [](Rig& rig) { buildAxes(rig, "JointTrajectoryController", "demands"); },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         if (cycle == 150) rig.cluster().send("/it", "teach");
         moveSlowly(rig, cycle);
     }},
    {"JogController", true, [](Rig& rig) { buildAxes(rig, "JogController", "demands"); },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         if (cycle != runUp - 50 - startedIn(past)) return;
         rig.cluster().send("/it", "jog", {{"axis", std::int64_t{1}}, {"velocity", past}});
     }},
    // It presses something that gives way less in another past.
    {"GripperController", true,
     [](Rig& rig) {
         for (const char* path : {"/axis", "/demand"}) rig.add(path, "SlideGripperAxis");
         rig.add("/it", "GripperController", {{"axes", "/axis"}, {"demands", "/demand"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         write(rig, "/axis", "position", 0.05);
         write(rig, "/axis", "effort", cycle < runUp ? -20 * past : -20);
         if (cycle == 150) rig.cluster().send("/it", "grip", {{"force", 15 * past}});
     }},
    {"CartesianJogController", true,
     [](Rig& rig) {
         rig.add("/lbr", "KukaLbr");
         Rig::Pairs relates;
         for (int i = 1; i <= 7; ++i) {
             const std::string number = std::to_string(i);
             relates.emplace_back("axes", "/lbr/axes/" + number);
             relates.emplace_back("demands", "/lbr/demands/" + number);
         }
         rig.add("/it", "CartesianJogController", relates);
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         const Rig::Arguments up{{"linear", std::vector{0.02, 0.0, -0.1 * past}}};
         if (cycle % 100 == 50) rig.cluster().send("/it", "jog", up);
         if (cycle == runUp - 50) rig.cluster().send("/it", "elbow", {{"velocity", 0.2 * past}});
     }},
    {"AxisControllerSelector", true,
     [](Rig& rig) {
         rig.add("/axis", "RotaryAxisObservation");
         rig.add("/demand", "RotaryAxisConcept");
         for (const char* path : {"/one", "/two"}) {
             rig.add(path, "HoldAxisController", {{"axes", "/axis"}, {"demands", "/demand"}});
         }
         rig.add("/it", "AxisControllerSelector", {{"choices", "/one"}, {"choices", "/two"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         // It asks for a start that is refused, and again half a second later.
         feedAxis(rig, cycle, past);
         rig.tree().at("/axis").slot().quality = cycle < runUp ? Quality::Bad : Quality::Good;
     }},
    {"SineController", true, [](Rig& rig) { buildSine(rig, "/it"); }, feedNothing},
    // Its tip is slow, and it does not let go.
    {"CartesianFollowController", true,
     [](Rig& rig) {
         buildHand(rig);
         rig.add("/it", "CartesianFollowController",
                 {{"hand", "/hand"}, {"tip", "/tip"}, {"enable", "/button"}},
                 {{"greatestAngle", "1"}, {"greatestDistance", "1"}});
     },
     feedHand},
    {"ProcessorSelector", true,
     [](Rig& rig) {
         buildHand(rig);
         // Processors without demands: safe demands of others are no state of the selector.
         rig.add("/axis", "RotaryAxisObservation");
         for (const char* path : {"/moving", "/still"})
             rig.add(path, "ForwardKinematics", {{"axes", "/axis"}});
         rig.add("/it", "ProcessorSelector",
                 {{"whileMoving", "/moving"},
                  {"otherwise", "/still"},
                  {"hand", "/hand"},
                  {"enable", "/button"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedHand(rig, cycle, 1);
         // The hand stands still: for 30 cycles in one past, for 60 in the other.
         if (cycle < runUp - 30 * static_cast<std::int64_t>(past)) return;
         rig.tree().at("/hand").array<double>("linearVelocity")[0] = 0;
     }},
    {"SimulatedAxis", true,
     [](Rig& rig) {
         rig.add("/axis", "RotaryAxisObservation");
         rig.add("/demand", "RotaryAxisConcept");
         rig.add("/it", "SimulatedAxis", {{"demand", "/demand"}, {"observation", "/axis"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         if (cycle > 50) write(rig, "/demand", "position", std::sin(angleAt(cycle, past)));
     }},
    // Enabled since cycle 100; where its target was differs until `runUp`.
    {"Ds402SimulatedDrive", true,
     [](Rig& rig) {
         rig.add("/axis", "Ds402RotaryObservation");
         rig.add("/demand", "Ds402RotaryModification");
         rig.add("/it", "Ds402SimulatedDrive", {{"demands", "/demand"}, {"observations", "/axis"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         const std::int64_t word = cycle < 100 ? 0x06 : 0x0F;
         rig.tree().at("/demand").data<std::int64_t>("controlWord") = word;
         write(rig, "/demand", "position", 0.05 * std::sin(angleAt(cycle, past)));
         if (cycle == runUp - 30) rig.cluster().send("/it", "jumpEncoder", {{"by", 0.01 * past}});
     }},
    {"FieldbusMonitor", false,
     [](Rig& rig) {
         rig.add("/axis", "Ds402RotaryObservation");
         rig.add("/demand", "Ds402RotaryModification");
         rig.add("/drive", "Ds402SimulatedDrive",
                 {{"demands", "/demand"}, {"observations", "/axis"}});
         rig.add("/it", "FieldbusMonitor", {{"devices", "/drive"}});
     },
     feedNothing},
    {"HandsetPlayback", true,
     [](Rig& rig) {
         rig.add("/hand", "CartesianObservation");
         rig.add("/button", "DigitalIoConcept");
         rig.add("/it", "HandsetPlayback", {{"pose", "/hand"}, {"buttons", "/button"}},
                 {{"file", CORTEX_SOURCE_DIR "/examples/lbr_teleop/synthetic_hand_path.csv"}});
     },
     feedNothing},
    {"TrackingMonitor", true,
     [](Rig& rig) {
         buildHand(rig);
         buildSine(rig, "/sine");
         rig.add(
             "/it", "TrackingMonitor",
             {{"hand", "/hand"}, {"tip", "/tip"}, {"enable", "/button"}, {"processor", "/sine"}});
     },
     feedHand},
    {"PidController", true,
     [](Rig& rig) {
         buildNumbers(rig);
         rig.add("/it", "PidController",
                 {{"measured", "/number"}, {"setpoint", "/wish"}, {"output", "/heating"}},
                 {{"ki", "1"}, {"kd", "0.01"}, {"filterTime", "0.1"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         write(rig, "/number", "value", std::sin(5 * angleAt(cycle, past)));
         write(rig, "/wish", "value", 5);
     }},
    {"RateLimiter", false,
     [](Rig& rig) {
         buildNumbers(rig);
         rig.add("/it", "RateLimiter", {{"source", "/number"}, {"result", "/wish"}});
     },
     feedNumber},
    {"Filter", false,
     [](Rig& rig) {
         buildNumbers(rig);
         rig.add("/it", "Filter", {{"source", "/number"}, {"result", "/wish"}});
     },
     feedNumber},
    {"Ramp", true,
     [](Rig& rig) {
         buildNumbers(rig);
         rig.add("/it", "Ramp", {{"result", "/heating"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         // It begins elsewhere in another past, so another share of the way is done.
         if (cycle == 100) rig.cluster().send("/it", "goTo", {{"target", 0.1 * past}});
         if (cycle == runUp - 20) rig.cluster().send("/it", "goTo", {{"target", 1.0}});
     }},
    {"Watchdog", true,
     [](Rig& rig) {
         buildNumbers(rig);
         rig.add("/ok", "DigitalIoConcept");
         rig.add("/it", "Watchdog", {{"watched", "/number"}, {"ok", "/ok"}}, {{"item", "value"}});
     },
     // It stands still, for longer in one past than in the other.
     [](Rig& rig, std::int64_t cycle, double past) {
         const std::int64_t last = runUp - 30 * static_cast<std::int64_t>(past);
         write(rig, "/number", "value",
               static_cast<double>(std::min(cycle, last)) + (cycle > last ? 1000.0 : 0.0));
     }},
};

}  // namespace

const std::vector<Recipe>& recipes() { return allRecipes; }

std::int64_t startedIn(double past) { return static_cast<std::int64_t>(10 * past); }

}  // namespace cortex::toolkit::test
