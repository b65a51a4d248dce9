// SPDX-License-Identifier: Apache-2.0
#include "mujoco_places.hpp"

#include "mjcf.hpp"

#include <algorithm>

namespace cortex::physics {
namespace {

void name(std::vector<std::string>& all, int place, int count, const std::string& path) {
    std::fill_n(all.begin() + place, count, path);
}

}  // namespace

MujocoPlaces::MujocoPlaces(const Scene& scene, const mjModel& model)
    : ofPosition(static_cast<std::size_t>(model.nq)),
      ofVelocity(static_cast<std::size_t>(model.nv)),
      ofMotor(static_cast<std::size_t>(model.nu)) {
    for (const Arm& arm : scene.arms) {
        for (const Joint& joint : arm.joints) {
            DrivePlace place{.first = slide(model, joint.path, joint.path)};
            place.mass = model.dof_Madr[place.first.velocity];
            addDrive(model, place, joint);
        }
    }
    for (const Gripper& gripper : scene.grippers) {
        const Joint& opening = gripper.opening;
        addDrive(model,
                 {.first = slide(model, jawName(gripper, 1), opening.path),
                  .second = slide(model, jawName(gripper, 2), opening.path),
                  .isGripper = true,
                  .limitsForce = gripper.limitsForce,
                  // Each of two jaws has half of the mass, and moves half of the way.
                  .inertia = opening.mass / 4 + opening.armature,
                  .leastForce = gripper.leastForce},
                 opening);
    }
    for (const Body& body : scene.bodies) {
        if (body.mass > 0) addBody(model, body);
    }
}

DrivePlace::Slide MujocoPlaces::slide(const mjModel& model, const std::string& name,
                                      const std::string& path) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, name.c_str());
    const DrivePlace::Slide place{model.jnt_qposadr[joint], model.jnt_dofadr[joint]};
    physics::name(ofPosition, place.position, 1, path);
    physics::name(ofVelocity, place.velocity, 1, path);
    return place;
}

void MujocoPlaces::addDrive(const mjModel& model, DrivePlace place, const Joint& joint) {
    place.motor = mj_name2id(&model, mjOBJ_ACTUATOR, joint.path.c_str());
    place.limit = joint.effort;
    place.start = joint.start;
    name(ofMotor, place.motor, 1, joint.path);
    drives.push_back(place);
}

void MujocoPlaces::addBody(const mjModel& model, const Body& body) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, body.path.c_str());
    const BodyPlace place{model.jnt_qposadr[joint], model.jnt_dofadr[joint]};
    name(ofPosition, place.position, 7, body.path);
    name(ofVelocity, place.velocity, 6, body.path);
    bodies.push_back(place);
}

}  // namespace cortex::physics
