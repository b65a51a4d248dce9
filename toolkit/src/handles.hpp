// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex.hpp"
#include "cortex/toolkit/serial_chain.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::toolkit {

// Handles to the items of a CartesianConcept or an AxisConcept that is related to.
struct PoseInput {
    PoseInput() = default;
    explicit PoseInput(const InputSimplex& frame);

    Pose pose() const CORTEX_REALTIME;
    Twist velocity() const CORTEX_REALTIME;  // linear above angular
    bool good() const CORTEX_REALTIME { return state->quality == Quality::Good; }

    std::span<const double> position, rotation, linearVelocity, angularVelocity;
    const SlotState* state = nullptr;
};

struct PoseOutput {
    PoseOutput() = default;
    explicit PoseOutput(const OutputSimplex& frame);

    void write(const Pose& pose, const Twist& velocity) CORTEX_REALTIME;

    std::span<double> position, rotation, linearVelocity, angularVelocity;
};

struct AxisInput {
    explicit AxisInput(const InputSimplex& axis);
    Data<const double> position, velocity;
};

struct AxisOutput {
    explicit AxisOutput(const OutputSimplex& axis);
    void write(double newPosition, double newVelocity) CORTEX_REALTIME;
    Data<double> position, velocity, effort;
};

std::vector<AxisInput> axisInputs(const std::vector<InputSimplex>& axes);
std::vector<AxisOutput> axisOutputs(const std::vector<OutputSimplex>& axes);

// Limits that the type of an axis states; infinite where it states none.
struct AxisLimits {
    explicit AxisLimits(const Type& axis);
    double min, max, speed;
};

// Throws Error unless there are as many of the one as of the other.
void requireSameCount(const Simplex& owner, std::size_t axes, std::size_t others,
                      const char* otherRule);

// Geometry and limits of a chain as its axes state them.
SerialChain chainOf(const Simplex& owner, const std::vector<InputSimplex>& axes,
                    std::span<const double> tipPosition, std::span<const double> tipRotation);

}  // namespace cortex::toolkit
