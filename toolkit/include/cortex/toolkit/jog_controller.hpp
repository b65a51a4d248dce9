// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/axis_controller.hpp"
#include "cortex/toolkit/held_jog.hpp"
#include "cortex/toolkit/target_item.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cortex::toolkit {

// Moves single axes by hand: to a position, at a velocity for as long as the command is repeated,
// or by steps. Before a limit it slows down by its braking way.
class JogController : public AxisController {
public:
    using AxisController::AxisController;

protected:
    enum Mode : std::int64_t { Hold, Position, Velocity, Step };

    void populate() override;
    void loopStart(const Tick& tick) CORTEX_REALTIME override;
    void settingsProposed(ProposedSettings& proposed) CORTEX_REALTIME override;
    void settingsChanged() CORTEX_REALTIME override;
    void takeOver(const Tick& tick) CORTEX_REALTIME override;
    void move(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    Mode mode() const { return static_cast<Mode>(mode_.get()); }
    bool rests() const CORTEX_REALTIME;                              // all axes
    void brake(std::size_t axis, std::int64_t now) CORTEX_REALTIME;  // now: nominal, ns
    // False where that cannot be planned.
    bool moveTo(std::size_t axis, double position) CORTEX_REALTIME;

private:
    struct Motion {
        mechanics::Profile profile;
        double time = 0;      // s, since the profile began
        double velocity = 0;  // that jog asked for
        double aim = 0;       // velocity that the profile leads to
        HeldJog held;
        bool toLimit = false;  // the profile ends at a limit

        void keep(Archive& archive) { archive & profile & time & velocity & aim & held & toLimit; }
        bool rests() const { return time >= profile.duration() && profile.end().velocity == 0; }
    };
    // The commands.
    Outcome setMode(Call& call) CORTEX_REALTIME;
    Outcome jog(Call& call) CORTEX_REALTIME;
    Outcome go(Call& call) CORTEX_REALTIME;
    Outcome step(Call& call) CORTEX_REALTIME;
    Outcome halt(Call& call) CORTEX_REALTIME;

    // The axis that a command names, from 0; nothing, and the call is rejected: it is none, it does
    // not follow, or the mode is another one.
    std::optional<std::size_t> axisOf(Call& call, std::int64_t axis, std::string_view command,
                                      Mode needed) CORTEX_REALTIME;
    Outcome runTo(Call& call, std::size_t axis) CORTEX_REALTIME;
    void begin(std::size_t axis, const mechanics::Profile& profile) CORTEX_REALTIME;
    void aimAt(std::size_t axis, double velocity) CORTEX_REALTIME;
    void keepBeforeLimits(std::size_t axis, double seconds) CORTEX_REALTIME;

    std::vector<Motion> motions_;
    TargetItem demandPosition_;
    std::span<const double> stepSize_;
    std::span<double> demandVelocity_;
    Data<const double> holdTime_, speedShare_;
    Data<double> progress_;
    Data<bool> jogging_;
    Data<std::int64_t> mode_, axis_;
    Argument<std::int64_t> newMode_, jogAxis_, goAxis_, stepAxis_, stepDirection_;
    Argument<double> jogVelocity_;
    std::int64_t now_ = 0;     // ns
    std::size_t running_ = 0;  // axis of go or step
    // By halt; or by another writer, a limit or a lost input, where what went out is another
    // demand.
    enum class Interrupted : std::uint8_t { Not, ByHalt, ByOthers };
    Interrupted interrupted_ = Interrupted::Not;
};

}  // namespace cortex::toolkit
