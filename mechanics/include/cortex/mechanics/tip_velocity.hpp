// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/serial_chain.hpp"

#include <array>
#include <cstddef>

namespace cortex::mechanics {

// Which of a tip's velocities count: along x, y, z, then about x, y, z. With fewer than six, a
// chain of fewer axes can follow.
using Directions = std::array<bool, 6>;
int count(const Directions& directions);

// Joint velocities for one of the tip, and how near the chain is to a singular posture, in which it
// cannot move its tip in every direction.
struct TipVelocity {
    SerialChain::JointVector joints;  // per s
    int counted = 0;                  // singular values of the Jacobian, the smallest first
    std::array<double, 6> values{};
    std::array<double, 6> needs{};  // share of the joints' velocity that each of them takes
    double manipulability = 0;      // product of the singular values
    double lost = 0;                // share of the tip's velocity that is left out

    double smallest() const { return values[0]; }
    double largest() const { return values[static_cast<std::size_t>(counted) - 1]; }
};

// A direction of which the singular value is below this share of the largest one is lost.
inline constexpr double lostBelow = 0.0025;

// The shortest q' with J q' = x': by the pseudoinverse of J (T. Yoshikawa, Foundations of Robotics,
// MIT Press 1990, section 4.6). It is not damped: near a singular posture q' becomes long, and the
// tip goes straight for whoever slows down. What is asked for in lost directions is left out.
// Jacobian and tip are in one frame, and a direction counts at least. Allocates nothing.
TipVelocity jointVelocities(const SerialChain::Jacobian& jacobian, const Twist& tip,
                            const Directions& directions);

// A motion of the joints, of length 1, that leaves the tip where it is: an arm of seven axes turns
// its elbow. The one that goes on like `before` where there are several; zero where there is none.
SerialChain::JointVector selfMotion(const SerialChain::Jacobian& jacobian,
                                    const Directions& directions,
                                    const SerialChain::JointVector& before);

}  // namespace cortex::mechanics
