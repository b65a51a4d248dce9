// SPDX-License-Identifier: Apache-2.0
// The example of two tele-operated arms in a glove box, stepped by hand: all agents' parts in one.
#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/classes.hpp"

#include "core/model_folder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

const std::string dualArmFolder = CORTEX_SOURCE_DIR "/examples/lbr_dual_arm/";
constexpr double gravity = 9.80665;

class DualArm : public testing::Test, protected cs::TestPlant {
protected:
    static constexpr int cyclesPerSecond = 250;

    DualArm() : TestPlant{{dualArmFolder + "lbr_dual_arm.xml"}, 4ms} {
        toolkit::addClasses(classes());
        loadPlugin(CORTEX_MUJOCO_PLUGIN);
        start();
        startUp();
    }

    // Until the paths of the hands are there.
    void runTo(double seconds) {
        while (get<double>("/hands/left/playback", "time") < seconds) step();
    }
    Eigen::Vector3d place(const std::string& path) {
        const auto values =
            std::get<std::vector<double>>(cluster().image().value(path, "position"));
        return {values[0], values[1], values[2]};
    }
    Eigen::Vector3d tip(const std::string& side) { return place("/" + side + "/forward/tip"); }
    std::vector<double> axes() {
        std::vector<double> positions;
        for (const char* side : {"/left", "/right"}) {
            for (int i = 1; i <= 7; ++i) {
                positions.push_back(
                    get<double>(side + ("/lbr/axes/" + std::to_string(i)), "position"));
            }
            positions.push_back(get<double>(side + std::string{"/gripper/opening"}, "position"));
        }
        return positions;
    }
    static double farthest(const std::vector<double>& one, const std::vector<double>& other) {
        double distance = 0;
        for (std::size_t i = 0; i < one.size(); ++i)
            distance = std::max(distance, std::abs(one[i] - other[i]));
        return distance;
    }
    std::vector<double> weightOf(const std::string& side);
    Eigen::Vector3d vector(const std::string& path, const std::string& item) {
        const auto values = tree().at(path).array<const double>(item);
        return {values[0], values[1], values[2]};
    }
};

Eigen::Quaterniond turned(const Eigen::Vector3d& angles) {
    return Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX());
}

// The moment of the weight of all that an axis carries, from what the types say: N·m of each axis.
std::vector<double> DualArm::weightOf(const std::string& side) {
    std::vector<Eigen::Vector3d> origins, directions, centres;
    std::vector<double> masses;
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    for (int i = 1; i <= 7; ++i) {
        const std::string axis = "/" + side + "/lbr/axes/" + std::to_string(i);
        const Eigen::Vector3d direction = vector(axis, "direction");
        frame.translate(vector(axis, "originPosition"));
        frame.rotate(turned(vector(axis, "originRotation")));
        frame.rotate(Eigen::AngleAxisd(get<double>(axis, "position"), direction));
        origins.emplace_back(frame.translation());
        directions.emplace_back(frame.linear() * direction);
        centres.emplace_back(frame * vector(axis, "linkCentre"));
        masses.push_back(get<double>(axis, "linkMass"));
    }
    const std::string gripper = "/" + side + "/gripper";
    for (const auto& [mass, centre] :
         {std::pair{get<double>(gripper, "bodyMass"), vector(gripper, "bodyCentre")},
          std::pair{get<double>(gripper + "/opening", "linkMass"),
                    vector(gripper, "jawPosition")}}) {
        masses.push_back(mass);
        centres.emplace_back(frame * centre);
    }
    std::vector<double> moments;
    for (std::size_t axis = 0; axis < origins.size(); ++axis) {
        double moment = 0;
        for (std::size_t i = axis; i < masses.size(); ++i) {
            const Eigen::Vector3d weight{0, 0, masses[i] * gravity};
            moment += directions[axis].dot((centres[i] - origins[axis]).cross(weight));
        }
        moments.push_back(moment);
    }
    return moments;
}

TEST_F(DualArm, BothTipsFollowTheirHands) {
    runTo(23.5);

    for (const std::string side : {"left", "right"}) {
        const std::string tracking = "/" + side + "/tracking";
        EXPECT_LT(get<double>(tracking, "rmsPosition"), 2) << side;
        EXPECT_GT(get<double>(tracking, "time"), 5) << side;
        EXPECT_GT(get<double>(tracking, "rmsSpeed"), 0.05) << side;
        EXPECT_EQ(get<std::int64_t>("/" + side + "/clutch", "letGoCount"), 0) << side;
    }
    EXPECT_EQ(state("/cell/world"), State::Active);
}

TEST_F(DualArm, AtRestEachDriveCarriesTheWeightOfItsArmAndGripper) {
    runTo(1);

    for (const std::string side : {"left", "right"}) {
        const std::vector<double> weight = weightOf(side);
        for (std::size_t i = 0; i < weight.size(); ++i) {
            const std::string axis = "/" + side + "/lbr/axes/" + std::to_string(i + 1);
            EXPECT_NEAR(get<double>(axis, "effort"), weight[i], 1e-6) << axis;
        }
        EXPECT_GT(std::abs(weight[1]), 20) << side;
    }
}

TEST_F(DualArm, AGripperHoldsTheBoxWhileItsHandLiftsIt) {
    runTo(5.5);
    const double onTheBench = place("/cell/box/pose").z();
    cluster().send("/left/grip", "grip", {{"force", 30.0}});
    runTo(10.5);
    const Eigen::Vector3d atFirst = place("/cell/box/pose") - tip("left");
    EXPECT_NEAR(place("/cell/box/pose").z() - onTheBench, 0.2, 0.002);
    runTo(15.5);
    EXPECT_LT((place("/cell/box/pose") - tip("left") - atFirst).norm(), 0.001);

    runTo(19);
    cluster().send("/left/grip", "open");
    runTo(23.5);
    EXPECT_NEAR(place("/cell/box/pose").z(), onTheBench, 0.001);
    EXPECT_NEAR(tip("left").z() - place("/cell/box/pose").z(), 0.285, 0.01);
}

TEST_F(DualArm, AfterAnEmergencyStopNothingMovesUntilItIsResetAndTheTriggersArePressedAnew) {
    runTo(3);
    ASSERT_TRUE(get<bool>("/right/clutch", "engaged"));
    call("/cell/panel", "press");
    step(cyclesPerSecond / 5);
    EXPECT_EQ(state("/cell/world"), State::Fault);
    EXPECT_EQ(get<std::int64_t>("/cell/world", "faultCode"), 40);
    const std::vector<double> stopped = axes();
    runTo(11);
    EXPECT_LT(farthest(axes(), stopped), 1e-5);
    EXPECT_FALSE(call("/cell/world", "startup").done());

    call("/cell/panel", "release");
    call("/cell/panel", "reset");
    call("/cell/world", "clearFaults");
    cluster().send("/cell/world", "startup");
    while (state("/cell/world") != State::Active && cycle() < 20 * cyclesPerSecond) step();
    ASSERT_EQ(state("/cell/world"), State::Active);
    const Eigen::Vector3d left = tip("left"), right = tip("right");
    runTo(15);
    EXPECT_LT((tip("left") - left).norm(), 0.001);
    EXPECT_LT((tip("right") - right).norm(), 0.001);
    EXPECT_FALSE(get<bool>("/right/clutch", "engaged"));
    EXPECT_LT(get<double>("/right/tracking", "maxPosition"), 10) << "of the time before the stop";
}

// From rest to rest, between 0 and 1.
double eased(double time) {
    return (1 - std::cos(std::clamp(time, 0.0, 1.0) * std::numbers::pi)) / 2;
}

// The right hand goes down by 0.19 m, where the palm meets the cylinder after 0.114 m, and stays.
std::string pathOntoTheCylinder() {
    std::string text = "time,x,y,z,qx,qy,qz,qw,trigger\n";
    for (int i = 0; i <= 900; ++i) {
        const double time = i * 0.01, down = 0.19 * (eased(time - 1) - eased(time - 7));
        text += std::to_string(time) + ",0.4,0," + std::to_string(1 - down) + ",0,0,0,1," +
                (time >= 0.5 ? "1" : "0") + "\n";
    }
    return text;
}

TEST(DualArmWithSomethingInItsWay, LetsGoAndStaysWhereItIs) {
    const ModelFolder folder;
    for (const auto& file : std::filesystem::directory_iterator{dualArmFolder})
        folder.write(file.path().filename(), textOf(file.path()));
    folder.write("synthetic_right_hand_path.csv", pathOntoTheCylinder());
    cs::TestPlant plant{{folder.path() / "lbr_dual_arm.xml"}, 2ms};
    toolkit::addClasses(plant.classes());
    plant.loadPlugin(CORTEX_MUJOCO_PLUGIN);
    plant.start();
    plant.startUp();
    const auto tip = [&plant] {
        const auto place = std::get<std::vector<double>>(
            plant.cluster().image().value("/right/forward/tip", "position"));
        return Eigen::Vector3d{place[0], place[1], place[2]};
    };
    while (plant.get<std::int64_t>("/right/clutch", "letGoCount") == 0) {
        ASSERT_LT(plant.cycle(), 2500);
        plant.step();
    }
    const Eigen::Vector3d where = tip();
    double farthest = 0;
    for (int i = 0; i < 500; ++i) {
        plant.step();
        farthest = std::max(farthest, (tip() - where).norm());
    }
    EXPECT_LT(farthest, 0.01);
}

// The files of the two sides state the same but for names and places.
std::string sideAs(const std::string& file, const std::string& side) {
    std::string text = textOf(dualArmFolder + side + file);
    for (std::size_t at = text.find(side); at != std::string::npos; at = text.find(side, at + 1))
        text.replace(at, side.size(), "SIDE");
    for (const std::string base : {"0 0.35 ", "0 -0.35 "}) {
        for (std::size_t at = text.find(base); at != std::string::npos; at = text.find(base))
            text.replace(at, base.size(), "BASE");
    }
    return text;
}

TEST(FilesOfTheDualArm, SayTheSameOfBothSidesButForTheirPlaces) {
    for (const char* file : {"_arm.xml", "_hand.xml", "_operator.xml"}) {
        const std::string left = sideAs(file, "left");
        EXPECT_FALSE(left.empty()) << file;
        EXPECT_EQ(left, sideAs(file, "right")) << file;
    }
}

}  // namespace
}  // namespace cortex::test
