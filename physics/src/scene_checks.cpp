// SPDX-License-Identifier: Apache-2.0
#include "scene_checks.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <string_view>

#include <Eigen/Eigenvalues>

namespace cortex::physics {
namespace {

using Findings = std::vector<std::string>;

// Each arm, and each gripper without carrier, has a bit of its own in MuJoCo's 31.
constexpr std::size_t manipulatorLimit = 30;
// The memory that MuJoCo takes grows with its square; for this it is 60 MB.
constexpr int greatestContactLimit = 500;

void add(Findings& all, const std::string& path, const std::string& what) {
    all.push_back("'" + path + "' " + what);
}

// In SI units: beyond it the physics would fail in the first step, and name what is innocent.
constexpr double greatest = 1e6;

bool allUsable(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return std::abs(value) <= greatest; });
}

// What is wrong with numbers that are not usable.
std::string whyNot(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); })
               ? "is beyond a million"
               : "is not finite";
}

void checkNumbers(Findings& all, const std::string& path, std::string_view item,
                  std::span<const double> values) {
    if (allUsable(values)) return;
    add(all, path,
        "has a number in its " + std::string{item} + " that " + whyNot(values) + "; correct it");
}

void checkNotNegative(Findings& all, const std::string& path, std::string_view item,
                      std::span<const double> values) {
    const bool good = std::ranges::all_of(values, [](double value) { return value >= 0; });
    if (!good) add(all, path, "has a negative " + std::string{item} + "; give 0 or more");
}

void checkMass(Findings& all, const std::string& path, std::string_view item, double mass) {
    const std::string name{item};
    if (mass == 0)
        add(all, path, "states no mass (" + name + "); give it");
    else if (!(mass > 0 && mass <= greatest))
        add(all, path,
            "has a mass (" + name + ") that is not above 0, or beyond a million; correct it");
}

// A body's principal inertias are above 0, and none is greater than the sum of the two others.
void checkInertia(Findings& all, const std::string& path, std::string_view item,
                  const std::array<double, 6>& inertia) {
    const std::string name{item};
    if (!allUsable(inertia)) return checkNumbers(all, path, item, inertia);
    const auto [xx, yy, zz, xy, xz, yz] = inertia;
    Eigen::Matrix3d tensor;
    tensor << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
    const Eigen::Vector3d principal = Solver(tensor, Eigen::EigenvaluesOnly).eigenvalues();
    if (inertia == std::array<double, 6>{}) {
        add(all, path, "states no inertia (" + name + "); give it");
    } else if (!(principal[0] > 0)) {
        add(all, path,
            "has an inertia (" + name +
                ") that no body has: it is not positive about each axis; give xx yy zz xy xz yz "
                "about the centre of mass");
    } else if (principal[2] > (principal[0] + principal[1]) * (1 + 1e-9)) {
        add(all, path,
            "has an inertia (" + name +
                ") that no body has: about one axis it is more than about the two others together; "
                "give xx yy zz xy xz yz about the centre of mass");
    }
}

void checkDirection(Findings& all, const Joint& joint) {
    if (!allUsable(joint.direction))
        return checkNumbers(all, joint.path, "direction", joint.direction);
    const double length = std::hypot(joint.direction[0], joint.direction[1], joint.direction[2]);
    if (std::abs(length - 1) < 1e-6) return;
    std::ostringstream text;
    text << "has a direction of length " << length << "; make it a unit vector";
    add(all, joint.path, text.str());
}

void checkRange(Findings& all, const Joint& joint) {
    std::ostringstream text;
    if (!(joint.min < joint.max)) {
        text << "has the range " << joint.min << " to " << joint.max
             << "; its least position has to be below its greatest one";
    } else if (!(joint.start >= joint.min && joint.start <= joint.max)) {
        text << "starts at " << joint.start << ", outside of its range " << joint.min << " to "
             << joint.max << "; start it within";
    } else {
        return checkNumbers(all, joint.path, "position at the start", {&joint.start, 1});
    }
    add(all, joint.path, text.str());
}

// What arms and openings have in common.
void checkDrive(Findings& all, const Joint& joint) {
    checkNumbers(all, joint.path, "originPosition", joint.origin);
    checkNumbers(all, joint.path, "originRotation", joint.originRotation);
    checkDirection(all, joint);
    checkMass(all, joint.path, "linkMass", joint.mass);
    checkRange(all, joint);
    const std::array drive{joint.armature, joint.damping, joint.friction};
    checkNumbers(all, joint.path, "armature, damping or friction", drive);
    if (allUsable(drive)) checkNotNegative(all, joint.path, "armature, damping or friction", drive);
    if (!(joint.effort >= 0)) add(all, joint.path, "has no effort of 0 or more; correct its limit");
}

void checkBox(Findings& all, const std::string& path, std::string_view item, const Triple& size) {
    checkNumbers(all, path, item, size);
    if (allUsable(size)) checkNotNegative(all, path, item, size);
}

void checkArm(Findings& all, const Arm& arm) {
    if (arm.joints.empty()) add(all, arm.path, "has no axes; give it one, or take it away");
    for (const Joint& joint : arm.joints) {
        checkDrive(all, joint);
        checkNumbers(all, joint.path, "linkCentre", joint.centre);
        checkInertia(all, joint.path, "linkInertia", joint.inertia);
        checkBox(all, joint.path, "linkSize", joint.size);
    }
}

void checkGripper(Findings& all, const Scene& scene, const Gripper& gripper) {
    const std::string& path = gripper.path;
    checkMass(all, path, "bodyMass", gripper.mass);
    checkNumbers(all, path, "bodyCentre", gripper.centre);
    checkInertia(all, path, "bodyInertia", gripper.inertia);
    checkBox(all, path, "bodySize", gripper.size);
    checkNumbers(all, path, "jawPosition", gripper.jawPosition);
    checkNumbers(all, path, "jawSize", gripper.jawSize);
    if (!std::ranges::all_of(gripper.jawSize, [](double side) { return side > 0; }))
        add(all, path, "has jaws without a size (jawSize); give thickness, width and length");
    if (!(gripper.leastForce >= 0 && gripper.leastForce <= gripper.opening.effort))
        add(all, path,
            "has a leastForce that is not between 0 and the greatest effort of its axis; correct "
            "it");
    if (gripper.opening.isRotary)
        add(all, gripper.opening.path, "is rotary, but opens a gripper; take a linear axis");
    if (gripper.carrier && *gripper.carrier >= scene.arms.size())
        add(all, path, "is carried by an arm that is not in the scene; add that arm");
    checkDrive(all, gripper.opening);
}

void checkShape(Findings& all, const Body& body) {
    const auto [x, y, z] = body.size;
    if (!(x > 0 && y > 0 && z > 0))
        add(all, body.path, "has a size that is not above 0; give all three edges");
    else if (body.shape == Body::Shape::Cylinder && x != y)
        add(all, body.path, "is a cylinder whose x and y differ; make both its diameter");
    else if (body.shape == Body::Shape::Sphere && (x != y || y != z))
        add(all, body.path, "is a sphere whose edges differ; make all three its diameter");
}

void checkBody(Findings& all, const Body& body) {
    checkNumbers(all, body.path, "size", body.size);
    checkNumbers(all, body.path, "position", body.position);
    checkNumbers(all, body.path, "rotation", body.rotation);
    const std::array physical{body.mass, body.friction};
    checkNumbers(all, body.path, "mass or friction", physical);
    if (allUsable(physical)) checkNotNegative(all, body.path, "mass or friction", physical);
    checkShape(all, body);
}

}  // namespace

std::vector<std::string> findings(const Scene& scene) {
    Findings all;
    if (scene.arms.empty() && scene.grippers.empty())
        all.emplace_back("There is no arm and no gripper in the scene; add one");
    if (scene.arms.size() + scene.grippers.size() > manipulatorLimit)
        all.emplace_back("There are more than " + std::to_string(manipulatorLimit) +
                         " arms and grippers in the scene; take some away");
    if (!allUsable(scene.gravity))
        all.emplace_back("The gravity has a number that " + whyNot(scene.gravity) + "; correct it");
    if (scene.contactLimit < 1 || scene.contactLimit > greatestContactLimit)
        all.emplace_back("The contactLimit is not in 1 to " + std::to_string(greatestContactLimit) +
                         "; give how many points of contact there may be");
    for (const Arm& arm : scene.arms) checkArm(all, arm);
    for (const Gripper& gripper : scene.grippers) checkGripper(all, scene, gripper);
    for (const Body& body : scene.bodies) checkBody(all, body);
    return all;
}

}  // namespace cortex::physics
