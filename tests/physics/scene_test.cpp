// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "physics/model_scene.hpp"

#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

namespace cortex::physics::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Scene wholeScene() {
    Scene scene = liftWith(shippedGripper());
    scene.bodies = {fixedBox("/table", {1, 1, 0.1}, {0, 0, 0}),
                    freeBody("/can", Body::Shape::Cylinder, {0.06, 0.06, 0.1}, 0.3, {0, 0, 0.2}),
                    freeBody("/ball", Body::Shape::Sphere, {0.1, 0.1, 0.1}, 0.3, {0.2, 0, 0.2})};
    return scene;
}

std::string refusal(const Scene& scene) {
    try {
        const Physics physics{scene};
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Scene, IsTakenWhereNothingIsWrong) { EXPECT_EQ(refusal(wholeScene()), ""); }

struct Hostile {
    std::function<void(Scene&)> spoil;
    std::string finding;
};

// Each value alone, and what is said of it.
TEST(Scene, IsRefusedForEachValueThatNoThingHas) {
    const auto slide = [](Scene& scene) -> Joint& { return scene.arms[0].joints[0]; };
    const auto gripper = [](Scene& scene) -> Gripper& { return scene.grippers[0]; };
    const std::vector<Hostile> all{
        {[&](Scene& s) { slide(s).mass = 0; }, "'/lift/slide' states no mass (linkMass); give it"},
        {[&](Scene& s) { slide(s).mass = -1; }, "'/lift/slide' has a mass (linkMass) that is not"},
        {[&](Scene& s) { slide(s).mass = nan; }, "'/lift/slide' has a mass (linkMass) that is not"},
        {[&](Scene& s) { gripper(s).mass = 0; }, "'/gripper' states no mass (bodyMass); give it"},
        {[&](Scene& s) { gripper(s).opening.mass = 0; },
         "'/gripper/opening' states no mass (linkMass); give it"},
        {[&](Scene& s) { slide(s).inertia = {}; },
         "'/lift/slide' states no inertia (linkInertia); give it"},
        {[&](Scene& s) { slide(s).inertia = {0.1, 0.1, -0.01, 0, 0, 0}; },
         "'/lift/slide' has an inertia (linkInertia) that no body has: it is not positive"},
        {[&](Scene& s) { slide(s).inertia = {0.1, 0.1, 0.1, 0.2, 0, 0}; },
         "'/lift/slide' has an inertia (linkInertia) that no body has: it is not positive"},
        {[&](Scene& s) { slide(s).inertia = {0.1, 0.1, 0.3, 0, 0, 0}; },
         "about one axis it is more than about the two others together"},
        {[&](Scene& s) { gripper(s).inertia = {0.1, 0.1, 0.3, 0, 0, 0}; },
         "'/gripper' has an inertia (bodyInertia)"},
        {[&](Scene& s) { slide(s).inertia[3] = nan; }, "'/lift/slide' has a number in its link"},
        {[&](Scene& s) { slide(s).direction = {0, 0, 2}; },
         "'/lift/slide' has a direction of length 2; make it a unit vector"},
        {[&](Scene& s) { gripper(s).opening.direction = {}; },
         "'/gripper/opening' has a direction of length 0"},
        {[&](Scene& s) { slide(s).direction[0] = nan; }, "number in its direction"},
        {[&](Scene& s) { slide(s).min = 2, slide(s).max = 1; },
         "'/lift/slide' has the range 2 to 1"},
        {[&](Scene& s) { slide(s).min = slide(s).max = 0; }, "has the range 0 to 0"},
        {[&](Scene& s) { slide(s).max = nan; }, "'/lift/slide' has the range"},
        {[&](Scene& s) { gripper(s).opening.start = 1; },
         "'/gripper/opening' starts at 1, outside of its range 0 to 0.085"},
        {[&](Scene& s) { slide(s).start = nan; }, "'/lift/slide' starts at nan"},
        {[&](Scene& s) { slide(s).start = Joint::unlimited; }, "number in its position at the s"},
        {[&](Scene& s) { slide(s).origin[1] = nan; }, "number in its originPosition"},
        {[&](Scene& s) { slide(s).originRotation[1] = nan; }, "number in its originRotation"},
        {[&](Scene& s) { slide(s).centre[1] = nan; }, "number in its linkCentre"},
        {[&](Scene& s) { slide(s).size[1] = nan; }, "number in its linkSize"},
        {[&](Scene& s) { slide(s).size[1] = -1; }, "has a negative linkSize"},
        {[&](Scene& s) { slide(s).damping = -1; }, "has a negative armature, damping or friction"},
        {[&](Scene& s) { slide(s).armature = nan; }, "number in its armature, damping or friction"},
        {[&](Scene& s) { slide(s).effort = nan; }, "has no effort of 0 or more"},
        {[&](Scene& s) { slide(s).effort = -1; }, "has no effort of 0 or more"},
        {[&](Scene& s) { gripper(s).jawSize[2] = 0; }, "'/gripper' has jaws without a size"},
        {[&](Scene& s) { gripper(s).jawSize[2] = nan; }, "'/gripper' has jaws without a size"},
        {[&](Scene& s) { gripper(s).jawPosition[2] = nan; }, "number in its jawPosition"},
        {[&](Scene& s) { gripper(s).centre[2] = nan; }, "number in its bodyCentre"},
        {[&](Scene& s) { gripper(s).size[2] = -1; }, "has a negative bodySize"},
        {[&](Scene& s) { gripper(s).leastForce = 300; }, "'/gripper' has a leastForce"},
        {[&](Scene& s) { gripper(s).leastForce = nan; }, "'/gripper' has a leastForce"},
        {[&](Scene& s) { gripper(s).opening.isRotary = true; }, "take a linear axis"},
        {[&](Scene& s) { gripper(s).carrier = 1; }, "carried by an arm that is not in the scene"},
        {[](Scene& s) { s.bodies[0].size[0] = 0; }, "'/table' has a size that is not above 0"},
        {[](Scene& s) { s.bodies[0].size[0] = nan; }, "'/table' has a number in its size"},
        {[](Scene& s) { s.bodies[1].size[0] = 0.05; }, "'/can' is a cylinder whose x and y differ"},
        {[](Scene& s) { s.bodies[2].size[2] = 0.05; }, "'/ball' is a sphere whose edges differ"},
        {[](Scene& s) { s.bodies[1].mass = -1; }, "'/can' has a negative mass or friction"},
        {[](Scene& s) { s.bodies[1].mass = nan; }, "'/can' has a number in its mass or friction"},
        {[](Scene& s) { s.bodies[1].friction = -1; }, "'/can' has a negative mass or friction"},
        {[](Scene& s) { s.bodies[1].position[0] = nan; }, "'/can' has a number in its position"},
        {[](Scene& s) { s.bodies[1].rotation[0] = nan; }, "'/can' has a number in its rotation"},
        {[](Scene& s) { s.gravity[2] = nan; }, "gravity has a number that is not finite"},
        {[](Scene& s) { s.gravity[2] = 1e7; }, "gravity has a number that is beyond a million"},
        {[&](Scene& s) { slide(s).mass = 1e308; }, "'/lift/slide' has a mass (linkMass) that is"},
        {[&](Scene& s) { slide(s).origin[0] = -1e300; },
         "'/lift/slide' has a number in its originPosition that is beyond a million; correct it"},
        {[](Scene& s) { s.bodies[1].rotation[0] = 1e300; }, "'/can' has a number in its rotation"},
        {[](Scene& s) { s.contactLimit = 0; }, "contactLimit is not in 1 to 500"},
        {[](Scene& s) { s.contactLimit = 1 << 30; }, "contactLimit is not in 1 to 500"},
        {[](Scene& s) { s.arms[0].joints.clear(); }, "'/lift' has no axes; give it one"},
        {[](Scene& s) { s = {}; }, "no arm and no gripper in the scene"},
        {[](Scene& s) { s.arms.resize(31, s.arms[0]); }, "more than 30 arms and grippers"},
        {[](Scene& s) { s.bodies.push_back(s.bodies[2]); }, "MuJoCo refuses the scene: "}};
    for (const Hostile& hostile : all) {
        Scene scene = wholeScene();
        hostile.spoil(scene);
        const std::string said = refusal(scene);
        EXPECT_NE(said.find(hostile.finding), std::string::npos)
            << "expected: " << hostile.finding << "\nsaid: " << said;
    }
}

TEST(Scene, IsRefusedWithAllFindingsAtOnce) {
    Scene scene = wholeScene();
    scene.arms[0].joints[0].mass = 0;
    scene.grippers[0].jawSize = {};
    scene.bodies[1].size = {};
    EXPECT_EQ(refusal(scene),
              "'/lift/slide' states no mass (linkMass); give it\n"
              "'/gripper' has jaws without a size (jawSize); give thickness, width and length\n"
              "'/can' has a size that is not above 0; give all three edges");
}

// A model in MuJoCo's language is read by MuJoCo alone.
TEST(SceneText, HoldsWhatTheSceneSays) {
    Scene scene = wholeScene();
    scene.arms[0].joints[0].max = 0.5;
    const std::string text = Physics{scene}.mjcf();
    for (
        const char* part :
        {R"(<compiler angle="radian"/>)", R"(nconmax="60")", R"(timestep="0.001")",
         R"(gravity="0 0 -9.80665")",
         R"(cone="elliptic" impratio="100" solver="Newton" iterations="50" tolerance="1e-10")",
         R"(<joint name="/lift/slide" type="slide" axis="0 0 1" limited="true" range="-1e+06 0.5")",
         R"(<inertial mass="2" pos="0 0 0" fullinertia="0.01 0.01 0.01 0 0 0"/>)",
         R"(<joint name="/gripper/opening#1" type="slide" axis="1 0 0" limited="true" range="0 0.0425" armature="1" damping="20")",
         R"(<joint joint1="/gripper/opening#1" joint2="/gripper/opening#2"/>)",
         R"(tendon="/gripper/opening" ctrllimited="true" ctrlrange="-235 235")",
         R"(<geom name="/can" type="cylinder" size="0.03 0.05")",
         R"(<exclude body1="world" body2="/lift/slide"/>)"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

// Halfway to the next axis; where that is at the same place, or there is none, about the mass.
TEST(SceneText, PutsABoxAroundEachLink) {
    const std::string text = Physics{{.arms = {shippedLbr()}}}.mjcf();
    for (const char* part : {R"(<geom type="box" pos="0 0 0.18" size="0.085 0.085 0.18")",
                             R"(<geom type="box" pos="-3e-04 0.042 0.059" size="0.07 0.085 0.105")",
                             R"(<geom type="box" pos="0 0 0.21" size="0.07 0.07 0.21")",
                             R"(<geom type="box" pos="0 0 -0.025" size="0.03 0.03 0.015")"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(SceneText, EscapesWhatXmlCannotHave) {
    Scene scene = wholeScene();
    scene.bodies[1].path = "/a<b&\"c\"";
    EXPECT_EQ(refusal(scene), "");
}

// Each is one joint high, so that nothing but its own first link is near.
TEST(SceneContacts, AreThoseOfThingsThatMayTouch) {
    const auto contacts = [](const std::function<void(Scene&)>& change) {
        Joint link;
        link.path = "/one/1";
        link.mass = 1;
        link.inertia = {0.01, 0.01, 0.01, 0, 0, 0};
        link.size = {0.2, 0.2, 0.2};
        Scene scene{.arms = {{"/one", {link}}}, .contactLimit = 60};
        change(scene);
        return Physics{scene}.contacts();
    };
    const auto addLink = [](Scene& scene, const std::string& path) {
        Joint link = scene.arms[0].joints[0];
        link.path = path;
        return link;
    };
    const Body table = fixedBox("/table", {1, 1, 0.2}, {0, 0, -0.1});
    EXPECT_EQ(contacts([&](Scene& s) { s.bodies = {table}; }), 0) << "the first link stands on it";
    EXPECT_EQ(contacts([&](Scene& s) { s.arms[0].joints.push_back(addLink(s, "/one/2")); }), 0)
        << "two links of one arm";
    EXPECT_GT(contacts([&](Scene& s) {
                  s.arms[0].joints.push_back(addLink(s, "/one/2"));
                  s.bodies = {table};
              }),
              0)
        << "the second link is in it";
    EXPECT_GT(contacts([&](Scene& s) {
                  s.bodies = {freeBody("/box", Body::Shape::Box, {0.1, 0.1, 0.1}, 1, {})};
              }),
              0)
        << "a body in a link";
    EXPECT_GT(contacts([&](Scene& s) { s.arms.push_back({"/two", {addLink(s, "/two/1")}}); }), 0)
        << "two arms";
    EXPECT_EQ(contacts([&](Scene& s) {
                  s.grippers = {shippedGripper()};
                  s.grippers[0].carrier = 0;
              }),
              0)
        << "an arm and the gripper that it carries";
    EXPECT_GT(contacts([&](Scene& s) { s.grippers = {shippedGripper()}; }), 0)
        << "an arm and a gripper of its own";
}

}  // namespace
}  // namespace cortex::physics::test
