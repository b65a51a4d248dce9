// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cortex::physics {

using Triple = std::array<double, 3>;

// One axis with the link that it moves, as its type states them: m, rad, kg, kg.m2, N or N.m.
struct Joint {
    static constexpr double unlimited = std::numeric_limits<double>::infinity();

    std::string path{};
    bool isRotary = true;
    Triple origin{}, originRotation{};  // in the frame before it; roll, pitch, yaw
    Triple direction{0, 0, 1};
    double mass = 0;
    Triple centre{};
    std::array<double, 6> inertia{};  // xx yy zz xy xz yz, about the centre of mass
    double armature = 0, damping = 0, friction = 0;
    Triple size{};  // of the box around the link; 0: it touches nothing
    double min = -unlimited, max = unlimited, effort = unlimited;
    double start = 0;  // its position at first
};

// Joints one after the other, from the base to the tip.
struct Arm {
    std::string path{};
    std::vector<Joint> joints{};
};

// Two jaws with one drive; its joint is the opening between them, and has the mass of both.
struct Gripper {
    std::string path{};
    std::optional<std::size_t> carrier{};  // place of the arm that has it at its tip
    double mass = 0;                       // without the jaws
    Triple centre{};
    std::array<double, 6> inertia{};
    Triple size{};         // of the box around the centre
    Triple jawPosition{};  // middle between the jaws
    Triple jawSize{};      // thickness, width, length
    double leastForce = 0;
    bool limitsForce = false;  // it has a status: the effort of its demand is its greatest force
    Joint opening{};
};

struct Body {
    enum class Shape : std::uint8_t { Box, Cylinder, Sphere };
    std::string path{};
    Shape shape = Shape::Box;
    Triple size{0.1, 0.1, 0.1};  // edges of the box around it
    double mass = 0;             // 0: it is fixed
    Triple position{}, rotation{};
    double friction = 1;
};

// All that a world computes. Its joints have one order: those of the arms, arm by arm, then the
// openings of the grippers.
struct Scene {
    std::vector<Arm> arms{};
    std::vector<Gripper> grippers{};
    std::vector<Body> bodies{};
    Triple gravity{0, 0, -9.80665};
    double timeStep = 0.001;  // s, for other programs: Physics::step() says its own
    int contactLimit = 500;
};

}  // namespace cortex::physics
