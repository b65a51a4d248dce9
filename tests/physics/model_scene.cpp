// SPDX-License-Identifier: Apache-2.0
#include "model_scene.hpp"

#include "cortex/core/type_model.hpp"

#include <algorithm>
#include <numbers>
#include <variant>

namespace cortex::physics::test {
namespace {

double shippedNumber(const std::string& type, const std::string& item) {
    return shipped(type, item).at(0);
}

const DataItem& shippedItem(const std::string& type, const std::string& item) {
    static const TypeModel model = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/robotics.xml");
    return *model.at(type).findData(item);
}

Joint shippedAxis(const std::string& path, const std::string& type) {
    Joint joint;
    joint.path = path;
    joint.origin = shippedTriple(type, "originPosition");
    joint.originRotation = shippedTriple(type, "originRotation");
    joint.direction = shippedTriple(type, "direction");
    joint.mass = shippedNumber(type, "linkMass");
    joint.centre = shippedTriple(type, "linkCentre");
    std::ranges::copy(shipped(type, "linkInertia"), joint.inertia.begin());
    joint.armature = shippedNumber(type, "armature");
    joint.damping = shippedNumber(type, "damping");
    joint.size = shippedTriple(type, "linkSize");
    const DataItem& position = shippedItem(type, "position");
    joint.min = std::get<double>(position.min.value());
    joint.max = std::get<double>(position.max.value());
    joint.effort = std::get<double>(shippedItem(type, "effort").max.value());
    return joint;
}

}  // namespace

std::vector<double> shipped(const std::string& type, const std::string& item) {
    return std::get<std::vector<double>>(shippedItem(type, item).initial);
}

Triple shippedTriple(const std::string& type, const std::string& item) {
    const std::vector<double> values = shipped(type, item);
    return {values.at(0), values.at(1), values.at(2)};
}

Arm shippedLbr(const std::array<double, 7>& start) {
    Arm arm{"/lbr"};
    for (std::size_t i = 0; i < start.size(); ++i) {
        const std::string number = std::to_string(i + 1);
        arm.joints.push_back(shippedAxis("/lbr/" + number, "KukaLbrAxis" + number));
        arm.joints.back().start = start[i];
    }
    return arm;
}

Gripper shippedGripper() {
    const std::string type = "Robotiq2Finger";
    Gripper gripper;
    gripper.path = "/gripper";
    gripper.mass = shippedNumber(type, "bodyMass");
    gripper.centre = shippedTriple(type, "bodyCentre");
    std::ranges::copy(shipped(type, "bodyInertia"), gripper.inertia.begin());
    gripper.size = shippedTriple(type, "bodySize");
    gripper.jawPosition = shippedTriple(type, "jawPosition");
    gripper.jawSize = shippedTriple(type, "jawSize");
    gripper.leastForce = shippedNumber(type, "leastForce");
    gripper.limitsForce = true;
    gripper.opening = shippedAxis("/gripper/opening", "Robotiq2FingerAxis");
    gripper.opening.isRotary = false;
    gripper.opening.start = gripper.opening.max;
    return gripper;
}

Scene liftWith(const Gripper& gripper) {
    Joint slide;
    slide.path = "/lift/slide";
    slide.isRotary = false;
    slide.origin = {0, 0, 0.5};
    slide.mass = 2;
    slide.inertia = {0.01, 0.01, 0.01, 0, 0, 0};
    Scene scene{.arms = {{"/lift", {slide}}}, .grippers = {gripper}, .contactLimit = 60};
    scene.grippers[0].carrier = 0;
    scene.grippers[0].opening.originRotation = {std::numbers::pi, 0, 0};
    return scene;
}

Body freeBody(const std::string& path, Body::Shape shape, const Triple& size, double mass,
              const Triple& position) {
    return {.path = path, .shape = shape, .size = size, .mass = mass, .position = position};
}

Body fixedBox(const std::string& path, const Triple& size, const Triple& position) {
    return {.path = path, .size = size, .position = position};
}

std::vector<JointDemand> staying(const Physics& physics, bool braked) {
    std::vector<JointDemand> demands(physics.joints());
    for (std::size_t i = 0; i < demands.size(); ++i)
        demands[i] = {.position = physics.joint(i).position, .braked = braked};
    return demands;
}

std::vector<double> stateOf(const Physics& physics) {
    std::vector<double> all;
    for (std::size_t i = 0; i < physics.joints(); ++i) {
        const JointState joint = physics.joint(i);
        all.insert(all.end(), {joint.position, joint.velocity, joint.acceleration, joint.effort});
    }
    for (std::size_t i = 0; i < physics.movingBodies(); ++i) {
        const BodyState body = physics.body(i);
        for (const Triple& triple : {body.position, body.linearVelocity, body.angularVelocity})
            all.insert(all.end(), triple.begin(), triple.end());
        all.insert(all.end(), body.rotation.begin(), body.rotation.end());
    }
    return all;
}

}  // namespace cortex::physics::test
