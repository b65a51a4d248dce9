// SPDX-License-Identifier: Apache-2.0
// What a world says of relations that make no scene: path, rule, and what to do.
#include "cortex/core/error.hpp"

#include "mujoco_world.hpp"
#include "world_rig.hpp"

#include <functional>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace cortex::physics::test {
namespace {

// How a plant is spoiled, and what is said of it.
struct Spoiled {
    const char* name;
    std::function<void(Entries&)> spoil;
    std::string told;

    friend void PrintTo(const Spoiled& each, std::ostream* out) { *out << each.name; }
};

void relate(Entries& entries, const char* path, const char* rule, const char* to) {
    at(entries, path).relates.push_back({rule, to, false, false, {}});
}
void unrelate(Entries& entries, const char* path, const char* rule, const std::string& to) {
    std::erase_if(at(entries, path).relates,
                  [&](const auto& each) { return each.rule == rule && each.to == to; });
}
void addAxis(Entries& entries, const char* axis, const char* demand) {
    entries.push_back(entry(axis, "LiftAxis"));
    entries.push_back(entry(demand, "LiftAxis"));
    relate(entries, "/world", "observations", axis);
    relate(entries, "/world", "demands", demand);
}
void addGripper(Entries& entries, const char* path, const std::string& type) {
    const std::string root{path};
    addAxis(entries, (root + "/axis").c_str(), (root + "/demand").c_str());
    entries.push_back(entry(root, type, {{"axes", root + "/axis"}, {"demands", root + "/demand"}}));
    relate(entries, "/world", "manipulators", path);
}

const std::vector<Spoiled> spoiled{
    {"AnAxisIsNotObserved",
     [](Entries& all) {
         unrelate(all, "/world", "observations", "/lift/axis");
         unrelate(all, "/world", "demands", "/lift/demand");
         addAxis(all, "/lift/axes", "/other/demand");
     },
     "/world: axis 1 of /lift is /lift/axis, which is not under rule 'observations' (nearest of: "
     "/lift/axes): relate it there, and its demand at the same place of rule 'demands'\n"
     "/world: /lift/axes under rule 'observations' is an axis of no manipulator of this world: "
     "relate that one under rule 'manipulators', or leave axis and demand out"},
    {"AnObservationIsOfNoManipulator", [](Entries& all) { addAxis(all, "/spare", "/spareDemand"); },
     "/world: /spare under rule 'observations' is an axis of no manipulator of this world: relate "
     "that one under rule 'manipulators', or leave axis and demand out"},
    {"AnObservationIsOfTwo",
     [](Entries& all) {
         all.push_back(entry("/twin", "SerialManipulator",
                             {{"axes", "/lift/axis"}, {"demands", "/lift/demand"}}));
         relate(all, "/world", "manipulators", "/twin");
     },
     "/world: /lift/axis under rule 'observations' is an axis of /lift and of /twin: leave one of "
     "the two out"},
    {"ADemandIsOfAnotherAxis",
     [](Entries& all) {
         all.push_back(entry("/wish", "LiftAxis"));
         unrelate(all, "/lift", "demands", "/lift/demand");
         relate(all, "/lift", "demands", "/wish");
         std::erase_if(all, [](const auto& each) { return each.path == "/lifter"; });
     },
     "/world: number 1 of rule 'observations' is /lift/axis, axis 1 of /lift, whose demand is "
     "/wish; number 1 of rule 'demands' is /lift/demand: relate the two in the same order"},
    {"OneBodyPoseIsMissing",
     [](Entries& all) {
         all.push_back(entry("/can", "SceneBody", {}, {{"mass", "1"}, {"position", "1 1 1"}}));
         relate(all, "/world", "bodies", "/can");
     },
     "/world: rule 'bodyPoses' has 1, and 2 under rule 'bodies' have a mass: relate one for each "
     "of them, in their order, or none at all"},
    {"AStatusIsOfNoGripper",
     [](Entries& all) {
         all.push_back(entry("/status", "GripperStatus"));
         relate(all, "/world", "statuses", "/status");
     },
     "/world: /status under rule 'statuses' is the status of no gripper of this world: relate it "
     "under rule 'status' of its gripper, or leave it out"},
    {"TheStatusOfAGripperIsMissing",
     [](Entries& all) { unrelate(all, "/world", "statuses", "/gripper/status"); },
     "/world: /gripper has the status /gripper/status, which is not under rule 'statuses': relate "
     "it there, as nobody else writes it"},
    {"TwoGrippersHaveOneStatus",
     [](Entries& all) {
         addGripper(all, "/second", "Robotiq2Finger");
         relate(all, "/second", "status", "/gripper/status");
     },
     "/world: /gripper/status under rule 'statuses' is the status of /gripper and of /second: give "
     "each a status of its own"},
    {"ACarrierIsNotInTheWorld",
     [](Entries& all) {
         all.push_back(entry("/left", "SerialManipulator",
                             {{"axes", "/leftAxis"}, {"demands", "/leftDemand"}}));
         all.push_back(entry("/leftAxis", "LiftAxis"));
         all.push_back(entry("/leftDemand", "LiftAxis"));
         unrelate(all, "/arm", "manipulator", "/lift");
         relate(all, "/arm", "manipulator", "/left");
     },
     "/world: /arm under rule 'arms' has as its manipulator /left, which is no "
     "SerialManipulator under rule 'manipulators' (nearest of: /lift): relate it there, or leave "
     "the arm "
     "out"},
    {"ACarriedGripperIsNotInTheWorld",
     [](Entries& all) {
         all.push_back(entry("/tool", "SlideGripper", {{"axes", "/toolAxis"}}));
         all.push_back(entry("/toolAxis", "LiftAxis"));
         unrelate(all, "/arm", "gripper", "/gripper");
         relate(all, "/arm", "gripper", "/tool");
     },
     "/world: /arm under rule 'arms' has as its gripper /tool, which is no gripper under rule "
     "'manipulators': relate it there, or leave the arm out"},
    {"OneManipulatorCarriesTwoGrippers",
     [](Entries& all) {
         addGripper(all, "/second", "SlideGripper");
         all.push_back(entry("/arm2", "Arm", {{"manipulator", "/lift"}, {"gripper", "/second"}}));
         relate(all, "/world", "arms", "/arm2");
     },
     "/world: /lift carries two grippers, /gripper and /second, the latter by /arm2 under rule "
     "'arms': leave one of the two out"},
    {"OneGripperIsCarriedByTwo",
     [](Entries& all) {
         addAxis(all, "/left/axis", "/left/demand");
         all.push_back(entry("/left", "SerialManipulator",
                             {{"axes", "/left/axis"}, {"demands", "/left/demand"}}));
         relate(all, "/world", "manipulators", "/left");
         all.push_back(entry("/arm2", "Arm", {{"manipulator", "/left"}, {"gripper", "/gripper"}}));
         relate(all, "/world", "arms", "/arm2");
     },
     "/world: /gripper is carried by two manipulators, /lift and /left, the latter by /arm2 under "
     "rule 'arms': leave one of the two out"},
    {"AManipulatorIsParallel",
     [](Entries& all) {
         addAxis(all, "/delta/axis", "/delta/demand");
         all.push_back(entry("/delta", "ParallelManipulator", {{"axes", "/delta/axis"}}));
         relate(all, "/world", "manipulators", "/delta");
     },
     "/world: /delta under rule 'manipulators' is a ParallelManipulator, and only a "
     "SerialManipulator, a OneDofManipulator and a Gripper can be computed: leave it out, with its "
     "axes\n"
     "/world: /delta/axis under rule 'observations' is an axis of no manipulator of this world: "
     "relate that one under rule 'manipulators', or leave axis and demand out"},
    {"ABodyIsOfAnotherAgent",
     [](Entries& all) {
         at(all, "/world").relates.push_back({"bodies", "/far/box", false, true, {}});
         relate(all, "/world", "bodyPoses", "/gone");
         all.push_back(entry("/gone", "CartesianObservation"));
     },
     "/world: /far/box under rule 'bodies' belongs to another agent, and its constants come when "
     "that is linked: let the agent that has it compute the world"},
};

std::string refusal(const Entries& entries) {
    try {
        WorldRig rig{entries};
        return "";
    } catch (const Error& error) {
        const std::string told = error.what();
        return told.substr(0, told.find_last_not_of('\n') + 1);
    }
}

class EverySpoiledScene : public testing::TestWithParam<Spoiled> {};

TEST_P(EverySpoiledScene, IsRefusedInWords) {
    Entries entries = liftPlant();
    GetParam().spoil(entries);
    EXPECT_EQ(refusal(entries), GetParam().told);
}

INSTANTIATE_TEST_SUITE_P(OfAWorld, EverySpoiledScene, testing::ValuesIn(spoiled),
                         [](const auto& each) { return std::string{each.param.name}; });

TEST(ASceneOfAWorld, HasAllThatItsRelationsSay) {
    Entries entries = liftPlant();
    addGripper(entries, "/loose", "SlideGripper");
    EXPECT_NE(refusal(entries).find("jaws without a size"), std::string::npos)
        << "the physics refuses what its types do not state: " << refusal(entries);
}

TEST(ASceneOfAWorld, IsToldAsMjcfWithThePathsAsNames) {
    WorldRig rig{liftPlant()};
    const auto& world = dynamic_cast<const MujocoWorld&>(rig.tree().at("/world"));
    const toolkit::HasModelText& teller = world;
    const std::string mjcf = teller.modelText();
    for (const char* part : {"<mujoco", "/lift/axis", "/gripper", "/table", "/box"})
        EXPECT_NE(mjcf.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace cortex::physics::test
