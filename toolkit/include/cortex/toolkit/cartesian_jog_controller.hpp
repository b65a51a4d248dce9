// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/mechanics/tip_velocity.hpp"
#include "cortex/toolkit/axis_controller.hpp"
#include "cortex/toolkit/held_jog.hpp"

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
    using Motion = std::array<double, motions>;

    // The commands.
    Outcome jog(Call& call) CORTEX_REALTIME;
    Outcome moveAs(Call& call, const Motion& motion) CORTEX_REALTIME;
    Outcome elbow(Call& call) CORTEX_REALTIME;
    Outcome halt(Call& call) CORTEX_REALTIME;

    // What the joints do at pace 1, and what becomes of it on the way.
    struct Course {
        mechanics::TipVelocity now;
        mechanics::SerialChain::JointVector bend;  // of their velocities, per s
        std::array<double, 6> falls{};             // of the singular values, per s
        double loses = 0;                          // of the tip's velocity, per s
    };

    // What the pace may be, and why it is not 1; how long it lasts at pace 1, and why no longer.
    struct Pace {
        mechanics::MotionLimits limits;
        double most = 1, way = 1e9;  // way: s
        HeldBack why = Nothing, end = Nothing;

        void atMost(double pace, HeldBack because) {
            if (pace >= most) return;
            most = pace;
            why = because;
        }
        void endsAfter(double time, HeldBack because) {
            if (time >= way) return;
            way = time;
            end = because;
        }
    };

    void readDirections();
    void stop() CORTEX_REALTIME;
    mechanics::MotionLimits limitsOf(std::size_t motion) const CORTEX_REALTIME;
    void aim() CORTEX_REALTIME;
    mechanics::TipVelocity wanted(const mechanics::SerialChain::JointVector& joints)
        CORTEX_REALTIME;
    Course course() CORTEX_REALTIME;
    mechanics::MotionLimits paceLimits(const mechanics::SerialChain::JointVector& joints) const
        CORTEX_REALTIME;
    void keepOnWay(const Course& course, Pace& pace) const CORTEX_REALTIME;
    void keepBeforeEnds(const Course& course, Pace& pace) CORTEX_REALTIME;
    void step(Pace pace, double seconds) CORTEX_REALTIME;
    bool stayTogether(const mechanics::SerialChain::JointVector& joints, double before,
                      double mostChange, double seconds) CORTEX_REALTIME;
    bool stepAll(const mechanics::SerialChain::JointVector& velocities, double seconds)
        CORTEX_REALTIME;
    void brakeAll(double seconds) CORTEX_REALTIME;

    std::optional<mechanics::SerialChain> chain_;
    mechanics::Directions directions_{};
    mechanics::SerialChain::JointVector joints_, elbow_;  // elbow_: its last direction
    mechanics::SerialChain::Jacobian jacobian_;
    std::vector<mechanics::MotionState> next_;
    // Velocities of the tip and of the elbow at pace 1; the pace is a velocity from 0 to 1.
    Motion direction_{}, aim_{};
    mechanics::MotionState pace_;
    double mostPace_ = 1;  // at which it moves as slowly as it was asked to
    bool drives_ = false;  // else it slows down
    std::int64_t usedFrame_ = Base;
    HeldJog held_;
    std::int64_t now_ = 0;  // ns

    Data<const std::int64_t> frame_;
    Data<const double> holdTime_, linearSpeed_, angularSpeed_, elbowSpeed_, rampTime_;
    Data<double> manipulability_, singularDistance_;
    Data<std::int64_t> heldBack_;
    Data<bool> jogging_;
    ArrayArgument<double> linear_, angular_;
    Argument<double> elbowVelocity_;
};

}  // namespace cortex::toolkit
