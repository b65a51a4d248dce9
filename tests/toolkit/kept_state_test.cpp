// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"

#include "lbr_chain.hpp"
#include "rig.hpp"

#include <cmath>
#include <cstring>
#include <functional>
#include <set>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr std::int64_t runUp = 400, runOn = 300;  // cycles

// How one class is made, started and fed. `past` makes one history differ from another; from cycle
// `runUp` on both are fed alike.
struct Recipe {
    std::string type;
    bool keeps;  // it has a state that is no item
    std::function<void(Rig&)> build;
    std::function<void(Rig&, std::int64_t cycle, double past)> feed;
};

void write(Rig& rig, const std::string& path, const std::string& item, double value) {
    rig.tree.at(path).data<double>(item) = value;
}

void press(Rig& rig, bool pressed) { rig.tree.at("/button").data<bool>("value") = pressed; }

void moveFrame(Rig& rig, const std::string& path, double angle) {
    const auto position = rig.tree.at(path).array<double>("position");
    const auto rotation = rig.tree.at(path).array<double>("rotation");
    const auto velocity = rig.tree.at(path).array<double>("linearVelocity");
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
    const auto position = rig.tree.at("/target").array<double>("position");
    const auto rotation = rig.tree.at("/target").array<double>("rotation");
    for (int i = 0; i < 3; ++i) position[static_cast<std::size_t>(i)] = pose.position[i];
    for (int i = 0; i < 4; ++i) rotation[static_cast<std::size_t>(i)] = pose.rotation.coeffs()[i];
}

void buildSine(Rig& rig, const std::string& name) {
    rig.add(name + "Axis", "VirtualAxis");
    rig.add(name, "SineController", {{"axis", name + "Axis"}});
}

void feedNothing(Rig&, std::int64_t, double) {}

// The longer the past, the later a startup came.
std::int64_t startedIn(double past) { return static_cast<std::int64_t>(10 * past); }

const std::vector<Recipe> recipes{
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
    {"HoldAxisController", true, [](Rig& rig) { buildAxes(rig, "HoldAxisController", "demands"); },
     feedAxis},
    {"FollowAxisController", false,
     [](Rig& rig) {
         rig.add("/axis", "RotaryAxisObservation");
         rig.add("/demand", "RotaryAxisConcept");
         rig.add("/target", "RotaryAxisConcept");
         rig.add("/it", "FollowAxisController",
                 {{"axes", "/axis"}, {"demands", "/demand"}, {"targets", "/target"}});
     },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         write(rig, "/target", "position", angleAt(cycle, past));
     }},
    {"AxisPoseController", true, [](Rig& rig) { buildAxes(rig, "AxisPoseController", "demands"); },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         if (cycle == runUp - 30) rig.cluster.send("/it", "moveTo", {{"speedShare", 0.01}});
     }},
    {"JogController", true, [](Rig& rig) { buildAxes(rig, "JogController", "demands"); },
     [](Rig& rig, std::int64_t cycle, double past) {
         feedAxis(rig, cycle, past);
         if (cycle != runUp - 50 - startedIn(past)) return;
         rig.cluster.send("/it", "jog", {{"axis", std::int64_t{1}}, {"velocity", past}});
     }},
    {"SineController", true, [](Rig& rig) { buildSine(rig, "/it"); }, feedNothing},
    {"CartesianFollowController", true,
     [](Rig& rig) {
         buildHand(rig);
         rig.add("/it", "CartesianFollowController",
                 {{"hand", "/hand"}, {"tip", "/tip"}, {"enable", "/button"}});
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
         rig.tree.at("/hand").array<double>("linearVelocity")[0] = 0;
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
};

// One plant with the class as `/it`, Active, and its history up to cycle `runUp`.
class Plant {
public:
    Plant(const Recipe& recipe, double past) : recipe_{recipe} {
        recipe.build(rig_);
        rig_.start();
        runTo(startedIn(past), past);
        rig_.cluster.send("/rig", "startup", {{"prefix", std::string{"/"}}});
        runTo(runUp, past);
        EXPECT_EQ(rig_.state("/it"), State::Active) << recipe.type;
    }
    // On from there: the cells after one cycle, halfway, and at the end.
    std::vector<std::byte> goOn() {
        std::vector<std::byte> all;
        for (const std::int64_t cycle : {runUp + 1, runUp + runOn / 2, runUp + runOn}) {
            runTo(cycle, 1);
            const std::vector<std::byte> now = cells();
            all.insert(all.end(), now.begin(), now.end());
        }
        return all;
    }

    std::vector<std::byte> saved() { return at("/it").savedState(); }
    // Everything as it is in another plant, but what `without` keeps.
    void restore(Plant& from, std::string_view without = {}) {
        const std::span<const std::byte> tables = from.tables();
        std::memcpy(const_cast<std::byte*>(this->tables().data()), tables.data(), tables.size());
        for (const auto& [path, simplex] : rig_.tree.simplexes()) {
            if (path == without || dynamic_cast<cs::SimplexCS*>(simplex.get()) == nullptr) continue;
            at(path).restoreState(from.at(path).savedState());
        }
    }

private:
    // Every cell that is not measured.
    std::vector<std::byte> cells() {
        std::vector<std::byte> all;
        AgentRuntime& agent = rig_.cluster.agent();
        for (std::uint32_t i = 0; i < agent.structure().simplexes.size(); ++i) {
            const SimplexInfo& info = agent.structure().simplexes[i];
            if (info.path == "/rig") continue;  // its metrics
            for (const ItemLayout& each : info.layout->items) {
                if (each.constant || each.item->measured) continue;
                const Value value =
                    loadValue(*each.item, agent.tables().live(i).at(each.item->kind, each.offset));
                for (const char c : info.path + each.item->name + toText(value))
                    all.push_back(static_cast<std::byte>(c));
            }
        }
        return all;
    }
    cs::SimplexCS& at(const std::string& path) {
        return dynamic_cast<cs::SimplexCS&>(rig_.tree.at(path));
    }
    std::span<const std::byte> tables() { return rig_.cluster.agent().tables().arena(); }
    void runTo(std::int64_t end, double past) {
        while (rig_.cluster.agent().cycle() < end) {
            recipe_.feed(rig_, rig_.cluster.agent().cycle() + 1, past);
            rig_.step();
        }
    }

    const Recipe& recipe_;
    Rig rig_;
};

class KeptState : public testing::TestWithParam<Recipe> {};

// Whoever forgets a member in keep() goes on otherwise than the one that was saved.
TEST_P(KeptState, MakesAFreshSimplexGoOnBitForBit) {
    Plant saved{GetParam(), 1}, fresh{GetParam(), 2};

    fresh.restore(saved);

    EXPECT_TRUE(saved.goOn() == fresh.goOn());
    EXPECT_EQ(saved.saved(), fresh.saved());
}

// Otherwise the test above would not see that something is missing.
TEST_P(KeptState, IsMissedWhereItIsNotRestored) {
    Plant saved{GetParam(), 1}, fresh{GetParam(), 2};

    fresh.restore(saved, "/it");

    EXPECT_EQ(saved.goOn() != fresh.goOn(), GetParam().keeps);
    EXPECT_EQ(!saved.saved().empty(), GetParam().keeps);
}

INSTANTIATE_TEST_SUITE_P(OfEachClass, KeptState, testing::ValuesIn(recipes),
                         [](const auto& each) { return each.param.type; });

TEST(KeptStateOfTheToolkit, IsTriedForEveryClass) {
    ClassRegistry registry;
    addClasses(registry);
    std::set<std::string> tried;
    for (const Recipe& recipe : recipes) tried.insert(recipe.type);

    const std::vector<std::string> names = registry.names();
    EXPECT_EQ(tried, (std::set<std::string>{names.begin(), names.end()}));
}

}  // namespace
}  // namespace cortex::toolkit::test
