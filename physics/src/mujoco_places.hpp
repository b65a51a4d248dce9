// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene.hpp"

#include <string>
#include <vector>

#include <mujoco/mujoco.h>

namespace cortex::physics {

// A joint of the scene in MuJoCo: one of its joints, or the two slides of a gripper.
struct DrivePlace {
    struct Slide {
        int position = 0, velocity = 0;
    };
    Slide first{};
    Slide second{};  // of a gripper
    bool isGripper = false;
    bool limitsForce = false;
    int motor = 0;
    int mass = 0;        // place of its inertia in MuJoCo's mass matrix
    double inertia = 0;  // of a gripper, which does not depend on any posture
    double limit = 0, leastForce = 0, start = 0;
};

struct BodyPlace {
    int position = 0, velocity = 0;
};

// Where MuJoCo has what the scene names, and the path of each of its numbers.
struct MujocoPlaces {
    MujocoPlaces(const Scene& scene, const mjModel& model);

    std::vector<DrivePlace> drives{};  // in the order of Scene
    std::vector<BodyPlace> bodies{};   // those with a mass
    std::vector<std::string> ofPosition{}, ofVelocity{}, ofMotor{};

private:
    DrivePlace::Slide slide(const mjModel& model, const std::string& name, const std::string& path);
    void addDrive(const mjModel& model, DrivePlace place, const Joint& joint);
    void addBody(const mjModel& model, const Body& body);
};

}  // namespace cortex::physics
