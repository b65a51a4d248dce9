// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/tip_velocity.hpp"
#include "cortex/toolkit/axis_controller.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace cortex::toolkit {

// Moves the tip of a serial chain by hand: along and about the axes of the base or of the tip, for
// as long as the command is repeated. An arm with a spare axis also turns its elbow. No axis leaves
// its limits; where one would, all of them slow down together.
class CartesianJogController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    enum HeldBack : std::int64_t { Nothing, Speed, Limit, Singularity };

    void populate() override;
    void loopStart(const Tick& tick) CORTEX_REALTIME override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

private:
    enum Frame : std::int64_t { Base, Tip };
    static constexpr std::size_t motions = 7;  // six of the tip, one of the elbow

    // The commands.
    Outcome jog(Call& call) CORTEX_REALTIME;
    Outcome elbow(Call& call) CORTEX_REALTIME;
    Outcome halt(Call& call) CORTEX_REALTIME;

    void readDirections();
    mechanics::MotionLimits limitsOf(std::size_t motion) const CORTEX_REALTIME;
    void slowTowardsAim(double seconds) CORTEX_REALTIME;
    mechanics::SerialChain::JointVector wanted() CORTEX_REALTIME;
    double share(const mechanics::SerialChain::JointVector& wanted, double seconds) CORTEX_REALTIME;
    bool stepAll(const mechanics::SerialChain::JointVector& velocities, double seconds)
        CORTEX_REALTIME;

    std::optional<mechanics::SerialChain> chain_;
    mechanics::Directions directions_{};
    mechanics::SerialChain::JointVector joints_, elbow_;  // elbow_: its last direction
    mechanics::SerialChain::Jacobian jacobian_;
    std::vector<mechanics::MotionState> next_;
    std::array<mechanics::MotionState, motions> smooth_{};  // of the tip: velocity, acceleration
    std::array<double, motions> aim_{};
    std::int64_t now_ = 0, until_ = 0;  // ns

    Data<const std::int64_t> frame_;
    Data<const double> holdTime_, linearSpeed_, angularSpeed_, elbowSpeed_, rampTime_;
    Data<double> manipulability_, singularDistance_;
    Data<std::int64_t> heldBack_;
    Data<bool> jogging_;
    ArrayArgument<double> linear_, angular_;
    Argument<double> elbowVelocity_;
};

}  // namespace cortex::toolkit
