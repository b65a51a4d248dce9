// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/simplex.hpp"
#include "cortex/mechanics/serial_chain.hpp"
#include "cortex/toolkit/axis_limits.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cortex::toolkit {

using mechanics::Pose;
using mechanics::SerialChain;
using mechanics::Twist;

// What keep() hands over of Eigen's types.
template <class Matrix>
void keep(Archive& archive, Eigen::PlainObjectBase<Matrix>& matrix) CORTEX_REALTIME {
    archive& std::span{matrix.data(), static_cast<std::size_t>(matrix.size())};
}
inline void keep(Archive& archive, Pose& pose) CORTEX_REALTIME {
    keep(archive, pose.position);
    archive& std::span{pose.rotation.coeffs().data(), 4};
}

// Handles to the items of a CartesianConcept or an AxisConcept that is related to.
struct PoseInput {
    PoseInput() = default;
    explicit PoseInput(const InputSimplex& frame);

    Pose pose() const CORTEX_REALTIME;
    Twist velocity() const CORTEX_REALTIME;  // linear above angular

    std::span<const double> position, rotation, linearVelocity, angularVelocity;
    const SlotState* state = nullptr;
};

// What enables a motion: on while the button is pressed and everything that the motion needs may be
// acted on. After a loss or a start it takes a new press.
class Enable {
public:
    Enable() = default;
    Enable(const InputSimplex& button, std::vector<const SlotState*> needed);

    void reset() CORTEX_REALTIME { released_ = false; }
    // Once a cycle. `lost`: an input is lost, so nothing is acted on.
    bool update(bool lost) CORTEX_REALTIME;
    bool usable() const { return usable_; }  // as of the last update
    void keep(Archive& archive) CORTEX_REALTIME { archive & needed_ & usable_ & released_; }

private:
    // A value that has only grown old, within its maxAge, is still acted on; one that its writer
    // calls stale is not.
    struct Needed {
        const SlotState* state = nullptr;
        std::int64_t time = 0;
        bool good = false;

        void keep(Archive& archive) CORTEX_REALTIME { archive & time & good; }
    };
    Data<const bool> pressed_;
    std::vector<Needed> needed_;
    bool usable_ = false, released_ = false;
};

struct PoseOutput {
    PoseOutput() = default;
    explicit PoseOutput(const OutputSimplex& frame);

    void write(const Pose& pose, const Twist& velocity) CORTEX_REALTIME;

    std::span<double> position, rotation, linearVelocity, angularVelocity;
};

struct AxisInput {
    explicit AxisInput(const InputSimplex& axis);
    Data<const double> position, velocity, acceleration;
};

struct AxisOutput {
    explicit AxisOutput(const OutputSimplex& axis);
    void write(double newPosition, double newVelocity, double newAcceleration = 0) CORTEX_REALTIME;
    Data<double> position, velocity, acceleration, effort;
};

std::vector<AxisInput> axisInputs(const std::vector<InputSimplex>& axes);
std::vector<AxisOutput> axisOutputs(const std::vector<OutputSimplex>& axes);

// What an axis says of its drive, by its item `status`, where that does not go where it is told;
// "" otherwise.
std::string_view whyStanding(std::int64_t status) CORTEX_REALTIME;
inline constexpr std::int64_t unknownStatus = 0, brakedStatus = 7;  // 0: it says nothing

// Throws Error unless there are as many of the one as of the other, where a morphology of the
// user's own lacks the rule's sameCount="axes", by which files are checked.
void requireSameCount(const Simplex& owner, std::size_t axes, std::size_t others,
                      const char* otherRule);

// Geometry and limits of a chain as its axes state them. Throws Error where another agent has one.
std::vector<mechanics::ChainJoint> chainJoints(const Simplex& owner,
                                               const std::vector<InputSimplex>& axes);
SerialChain chainOf(const Simplex& owner, const std::vector<InputSimplex>& axes,
                    std::span<const double> tipPosition, std::span<const double> tipRotation);

}  // namespace cortex::toolkit
