// SPDX-License-Identifier: Apache-2.0
#include "world_plants.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace cortex::physics::test {

SystemDescription::SimplexEntry entry(const std::string& path, const std::string& type,
                                      const Pairs& relates, const Pairs& settings) {
    SystemDescription::SimplexEntry made;
    made.path = path;
    made.type = type;
    for (const auto& [rule, to] : relates) made.relates.push_back({rule, to, false, false, {}});
    for (const auto& [item, value] : settings) made.settings.push_back({item, value, {}});
    return made;
}

Entries operator+(Entries one, const Entries& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

SystemDescription::SimplexEntry& at(Entries& entries, std::string_view path) {
    const auto found = std::ranges::find(entries, path, &SystemDescription::SimplexEntry::path);
    if (found == entries.end()) throw std::out_of_range{std::string{path}};
    return *found;
}

Entries lbrPlant(const Pairs& world) {
    Entries entries{entry("/lbr", "KukaLbr")};
    Pairs controlled, worldRelates{{"manipulators", "/lbr"}};
    for (std::size_t i = 0; i < lbrStart.size(); ++i) {
        const std::string number = std::to_string(i + 1), axis = "/lbr/axes/" + number,
                          demand = "/lbr/demands/" + number;
        entries.push_back(
            entry(axis, "KukaLbrAxis" + number, {}, {{"position", std::to_string(lbrStart[i])}}));
        entries.push_back(entry(demand, "KukaLbrAxis" + number));
        controlled.insert(controlled.end(), {{"axes", axis}, {"demands", demand}});
        worldRelates.insert(worldRelates.end(), {{"observations", axis}, {"demands", demand}});
    }
    entries.push_back(entry("/hold", "HoldAxisController", controlled));
    entries.push_back(entry("/pose", "AxisPoseController", controlled));
    entries.push_back(entry("/world", "MujocoWorld", worldRelates, world));
    return entries;
}

Entries tableAndBox(double above) {
    return {entry("/table", "SceneBody", {}, {{"size", "0.8 0.8 0.1"}, {"position", "0 0 0.35"}}),
            entry("/box", "SceneBody", {},
                  {{"size", "0.06 0.06 0.06"},
                   {"mass", "0.3"},
                   {"position", "0 0 " + std::to_string(0.43 + above)}}),
            entry("/boxPose", "CartesianObservation")};
}

Entries liftPlant(double above) {
    const Pairs carriage{{"axes", "/lift/axis"}, {"demands", "/lift/demand"}};
    const Pairs jaws{{"axes", "/gripper/opening"},
                     {"demands", "/gripper/demand"},
                     {"status", "/gripper/status"}};
    return tableAndBox(above) +
           Entries{entry("/lift", "SerialManipulator", carriage),
                   entry("/lift/axis", "LiftAxis", {},
                         {{"originPosition", "0 0 " + std::to_string(0.565 + above)}}),
                   entry("/lift/demand", "LiftAxis"),
                   entry("/gripper", "Robotiq2Finger", jaws),
                   entry("/gripper/opening", "Robotiq2FingerAxis", {},
                         {{"originRotation", "3.141592653589793 0 0"}, {"position", "0.085"}}),
                   entry("/gripper/demand", "Robotiq2FingerAxis"),
                   entry("/gripper/status", "GripperStatus"),
                   entry("/arm", "Arm", {{"manipulator", "/lift"}, {"gripper", "/gripper"}}),
                   entry("/lifter", "AxisPoseController", carriage),
                   entry("/grip", "GripperController", jaws),
                   entry("/world", "MujocoWorld",
                         {{"manipulators", "/lift"},
                          {"manipulators", "/gripper"},
                          {"arms", "/arm"},
                          {"bodies", "/table"},
                          {"bodies", "/box"},
                          {"bodyPoses", "/boxPose"},
                          {"statuses", "/gripper/status"},
                          {"observations", "/lift/axis"},
                          {"observations", "/gripper/opening"},
                          {"demands", "/lift/demand"},
                          {"demands", "/gripper/demand"}})};
}

Entries withoutControllers(Entries entries) {
    std::erase_if(entries, [](const auto& each) { return each.type.ends_with("Controller"); });
    return entries;
}

std::vector<std::filesystem::path> worldModel() {
    return {CORTEX_SOURCE_DIR "/ontology/cortex-morphology.xml",
            CORTEX_SOURCE_DIR "/tests/data/world-types.xml"};
}

}  // namespace cortex::physics::test
