// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/jog_controller.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cortex::toolkit {

using mechanics::MotionLimits;
using mechanics::MotionState;
using mechanics::Profile;

namespace {

std::string_view nameOf(std::int64_t mode) {
    constexpr std::array<std::string_view, 4> names{"Hold", "Position", "Velocity", "Step"};
    return names[static_cast<std::size_t>(mode)];
}

Profile stopFrom(const MotionState& state, const MotionLimits& limits) {
    return mechanics::planVelocity(state, 0, limits)
        .value_or(Profile::standing({state.position, 0, 0}));
}

}  // namespace

void JogController::populate() {
    AxisController::populate();
    motions_.resize(axisCount());
    demandPosition_.bind(*this, "demandPosition");
    demandVelocity_ = array<double>("demandVelocity");
    stepSize_ = array<const double>("stepSize");
    holdTime_ = data<const double>("holdTime");
    speedShare_ = data<const double>("speedShare");
    progress_ = data<double>("progress");
    jogging_ = data<bool>("jogging");
    mode_ = data<std::int64_t>("mode");
    axis_ = data<std::int64_t>("axis");
    newMode_ = argument<std::int64_t>("setMode", "mode");
    jogAxis_ = argument<std::int64_t>("jog", "axis");
    jogVelocity_ = argument<double>("jog", "velocity");
    goAxis_ = argument<std::int64_t>("go", "axis");
    stepAxis_ = argument<std::int64_t>("step", "axis");
    stepDirection_ = argument<std::int64_t>("step", "direction");
    on<&JogController::setMode>("setMode");
    on<&JogController::jog>("jog");
    on<&JogController::go>("go");
    on<&JogController::step>("step");
    on<&JogController::halt>("halt");
}

// --- motion -----------------------------------------------------------------------------------

bool JogController::rests() const {
    return std::ranges::all_of(motions_, [](const Motion& motion) { return motion.rests(); });
}

void JogController::begin(std::size_t axis, const Profile& profile) {
    motions_[axis].profile = profile;
    motions_[axis].time = 0;
    motions_[axis].toLimit = false;
}

void JogController::brake(std::size_t axis, std::int64_t now) {
    motions_[axis].held.end(now_, now);
    motions_[axis].aim = 0;
    begin(axis, stopFrom(demands()[axis], limits(axis).motion()));
}

bool JogController::moveTo(std::size_t axis, double position) {
    const auto profile =
        mechanics::planPosition(demands()[axis], position, limits(axis).motion(speedShare_));
    if (profile) begin(axis, *profile);
    motions_[axis].aim = 0;
    return profile.has_value();
}

void JogController::aimAt(std::size_t axis, double velocity) {
    if (motions_[axis].aim == velocity) return;
    const auto profile = mechanics::planVelocity(demands()[axis], velocity, limits(axis).motion());
    if (!profile) return;
    begin(axis, *profile);
    motions_[axis].aim = velocity;
}

// Where the state of this cycle could not be stopped before a limit, the axis goes to the limit.
void JogController::keepBeforeLimits(std::size_t axis, double seconds) {
    Motion& motion = motions_[axis];
    if (motion.aim == 0 || motion.toLimit) return;
    MotionLimits most = limits(axis).motion();
    const Profile stop = stopFrom(motion.profile.at(motion.time + seconds), most);
    const double limit = motion.aim > 0 ? limits(axis).max : limits(axis).min;
    const double beyond = stop.end().position - limit;
    if (motion.aim > 0 ? beyond <= 0 : beyond >= 0) return;
    const MotionState& now = demands()[axis];
    most.velocity = std::min(most.velocity, std::max(std::abs(motion.aim), std::abs(now.velocity)));
    if (const auto toLimit = mechanics::planPosition(now, limit, most)) begin(axis, *toLimit);
    motion.toLimit = true;
}

void JogController::takeOver(const Tick& tick) {
    for (std::size_t i = 0; i < axisCount(); ++i) {
        if (!takesOver(i)) continue;
        brake(i, tick.nominalTime);
        if (i == running_) interrupted_ = Interrupted::ByOthers;
    }
}

// Also where it is not Active, or an axis is lost: then move() is not called.
void JogController::loopStart(const Tick&) {
    jogging_ = false;
    for (std::size_t i = 0; i < axisCount(); ++i) demandPosition_.show(i, nearestInRange(i));
}

void JogController::settingsProposed(ProposedSettings& proposed) {
    demandPosition_.propose(proposed);
}

void JogController::settingsChanged() { demandPosition_.settle(); }

void JogController::move(const Tick& tick) {
    now_ = tick.nominalTime;
    const double seconds = tick.elapsedSeconds();
    for (std::size_t i = 0; i < axisCount(); ++i) {
        Motion& motion = motions_[i];
        const bool lasts = motion.held.lasts(now_);
        if (mode() == Velocity) aimAt(i, lasts ? motion.velocity : 0);
        keepBeforeLimits(i, seconds);
        motion.time += seconds;
        demands()[i] = motion.profile.at(motion.time);
        demandVelocity_[i] = lasts ? motion.velocity : 0;
        if (lasts) jogging_ = true;
    }
}

// --- commands ---------------------------------------------------------------------------------

std::optional<std::size_t> JogController::axisOf(Call& call, std::int64_t axis,
                                                 std::string_view command, Mode needed) {
    EventText why{command};
    if (mode() != needed) {
        why << " needs the mode " << nameOf(needed) << ", and it is " << nameOf(mode())
            << ": call setMode first";
        call.reject(Reason::State, why.view());
        return std::nullopt;
    }
    if (axis < 1 || static_cast<std::size_t>(axis) > axisCount()) {
        why << ": there is no axis " << axis << ", there are " << axisCount();
        call.reject(Reason::Range, why.view());
        return std::nullopt;
    }
    const auto place = static_cast<std::size_t>(axis - 1);
    if (!follows(place)) {
        call.reject(Reason::State, doesNotFollow(place).view());
        return std::nullopt;
    }
    axis_ = axis;
    return place;
}

Outcome JogController::jog(Call& call) {
    const auto axis = axisOf(call, call[jogAxis_], "jog", Velocity);
    if (!axis) return Outcome::Rejected;
    const double most = limits(*axis).motion().velocity;
    const double velocity = std::clamp(call[jogVelocity_].get(), -most, most);
    if (!motions_[*axis].held.begin(call, holdTime_, velocity != 0)) return Outcome::Rejected;
    motions_[*axis].velocity = velocity;
    return Outcome::Done;
}

Outcome JogController::runTo(Call& call, std::size_t axis) {
    if (call.cancelling()) {
        brake(axis, now_);
        return Outcome::Cancelled;
    }
    if (!follows(axis)) return call.fail(doesNotFollow(axis).view());
    if (interrupted_ == Interrupted::ByHalt) return call.fail("the motion was halted");
    if (interrupted_ == Interrupted::ByOthers)
        return call.fail("the demand was limited, or an axis was lost for a moment");
    const Motion& motion = motions_[axis];
    progress_ = motion.rests() ? 1.0 : motion.time / motion.profile.duration();
    return motion.rests() ? Outcome::Done : Outcome::Running;
}

Outcome JogController::go(Call& call) {
    if (call.first()) {
        const auto axis = axisOf(call, call[goAxis_], "go", Position);
        if (!axis || !demandPosition_.isGiven(call)) return Outcome::Rejected;
        const double position = demandPosition_[*axis];
        if (!inRange(call, "demandPosition", *axis, position)) return Outcome::Rejected;
        interrupted_ = Interrupted::Not;
        running_ = *axis;
        if (!moveTo(*axis, position)) return call.fail("no motion leads there");
    }
    return runTo(call, running_);
}

Outcome JogController::step(Call& call) {
    if (call.first()) {
        const auto axis = axisOf(call, call[stepAxis_], "step", Step);
        if (!axis) return Outcome::Rejected;
        const double way = static_cast<double>(call[stepDirection_]) * stepSize_[*axis];
        const double position = demands()[*axis].position + way;
        if (!inRange(call, "the step's end", *axis, position)) return Outcome::Rejected;
        interrupted_ = Interrupted::Not;
        running_ = *axis;
        if (!moveTo(*axis, position)) return call.fail("no motion leads there");
    }
    return runTo(call, running_);
}

Outcome JogController::halt(Call&) {
    for (std::size_t i = 0; i < axisCount(); ++i) brake(i, now_);
    interrupted_ = Interrupted::ByHalt;
    return Outcome::Done;
}

Outcome JogController::setMode(Call& call) {
    if (call.first()) {
        for (std::size_t i = 0; i < axisCount(); ++i) brake(i, now_);
        mode_ = Hold;
    }
    if (call.cancelling()) return Outcome::Cancelled;
    if (!rests()) return Outcome::Running;
    mode_ = call[newMode_];
    return Outcome::Done;
}

void JogController::keep(Archive& archive) {
    AxisController::keep(archive);
    archive.version("JogController", 5);
    archive & motions_ & running_ & interrupted_;
    archive.time(now_);
}

}  // namespace cortex::toolkit
