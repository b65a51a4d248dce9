// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/serial_chain.hpp"

#include <array>

namespace cortex::mechanics {

// Which of a tip's velocities count: along x, y, z, then about x, y, z. With fewer than six, a
// chain of fewer axes can follow.
using Directions = std::array<bool, 6>;
int count(const Directions& directions);

// Joint velocities for one of the tip, and how near the chain is to a posture in which it cannot
// move its tip in every direction.
struct TipVelocity {
    SerialChain::JointVector joints;  // per s
    double smallest = 0;              // singular value of the Jacobian
    double manipulability = 0;        // product of the singular values
    bool damped = false;              // near such a posture: the tip moves less than was asked for
};

// Damped least squares: q' = J'(JJ' + λ²I)^-1 x', with λ² = (1 − (σ/σ0)²)·λmax² where the smallest
// singular value σ is below σ0 = 0.05, and λmax = 0.05 (Y. Nakamura, H. Hanafusa, J. Dyn. Sys.
// Meas. Control 108 (1986); A. Maciejewski, C. Klein, J. Robotic Systems 5 (1988)). Jacobian and
// tip are in one frame. Allocates nothing.
TipVelocity jointVelocities(const SerialChain::Jacobian& jacobian, const Twist& tip,
                            const Directions& directions);

// A motion of the joints, of length 1, that leaves the tip where it is: an arm of seven axes turns
// its elbow. Of both signs the one that goes on like `before`; zero where the chain has none.
SerialChain::JointVector selfMotion(const SerialChain::Jacobian& jacobian,
                                    const Directions& directions,
                                    const SerialChain::JointVector& before);

}  // namespace cortex::mechanics
