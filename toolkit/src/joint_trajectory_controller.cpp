// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/joint_trajectory_controller.hpp"

#include "joint_points.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::toolkit {

namespace {

constexpr double overTheEnd = 0.001;  // rad or m that an axis at the end of its range may go over

}  // namespace

// What the thread for slow work has while it reads or writes.
struct JointTrajectoryController::Files {
    std::string files, folder, name;
    std::vector<PointAxis> axes;
    JointPoints points;
    cs::SlowWork save, load;

    // In a hook: nothing is allocated, as `name` has room for each that a command may give.
    void take(std::string_view newName) CORTEX_REALTIME { name.assign(newName); }
};

JointTrajectoryController::JointTrajectoryController(Identity identity)
    : AxisPoseController{std::move(identity)} {}

JointTrajectoryController::~JointTrajectoryController() = default;

void JointTrajectoryController::populate() {
    AxisPoseController::populate();
    points_ = std::make_unique<JointPoints>(axisCount());
    files_ = std::make_unique<Files>();
    Files& files = *files_;
    files.files = filesFolder();
    files.folder = data<const std::string_view>("folder").get();
    files.name.reserve(64);
    files.points = JointPoints{axisCount()};
    for (const InputSimplex& axis : inputs("axes")) {
        const std::size_t place = files.axes.size();
        files.axes.push_back({axis.path() + " " + axis.type().findData("position")->unit,
                              demandPath(place), limits(place)});
    }
    files.save = cs::SlowWork{[&files] {
        writeJointPoints(pointsFile(files.files, files.folder, files.name), files.axes,
                         files.points);
    }};
    files.load = cs::SlowWork{[&files] {
        files.points.assign(
            readJointPoints(pointsFile(files.files, files.folder, files.name), files.axes));
    }};
    pose_.resize(axisCount());
    pointCount_ = data<std::int64_t>("pointCount");
    point_ = data<std::int64_t>("point");
    name_ = data<std::string_view>("name");
    share_ = data<const double>("speedShare");
    loop_ = data<const bool>("loop");
    insertAt_ = argument<std::int64_t>("insert", "at");
    removeAt_ = argument<std::int64_t>("remove", "at");
    shown_ = argument<std::int64_t>("showPoint", "number");
    from_ = argument<std::int64_t>("run", "from");
    to_ = argument<std::int64_t>("run", "to");
    saveName_ = argument<std::string_view>("save", "name");
    loadName_ = argument<std::string_view>("load", "name");
    taught_ = result<std::int64_t>("teach", "point");
    position_ = arrayResult<double>("showPoint", "position");
    on<&JointTrajectoryController::teach>("teach");
    on<&JointTrajectoryController::insert>("insert");
    on<&JointTrajectoryController::remove>("remove");
    on<&JointTrajectoryController::clear>("clear");
    on<&JointTrajectoryController::showPoint>("showPoint");
    on<&JointTrajectoryController::run>("run");
    on<&JointTrajectoryController::next>("next");
    on<&JointTrajectoryController::previous>("previous");
    on<&JointTrajectoryController::save>("save");
    on<&JointTrajectoryController::load>("load");
}

bool JointTrajectoryController::stateStartingUp(const Tick& tick) {
    point_ = 0;
    return AxisPoseController::stateStartingUp(tick);
}

// --- points -----------------------------------------------------------------------------------

bool JointTrajectoryController::isPoint(Call& call, std::string_view argument,
                                        std::int64_t number) const {
    if (number >= 1 && static_cast<std::size_t>(number) <= points_->size()) return true;
    EventText why{argument};
    why << " is " << number << ", but there are " << static_cast<std::int64_t>(points_->size())
        << " points";
    call.reject(Reason::Range, why.view());
    return false;
}

// The observed pose, where the axes stand.
bool JointTrajectoryController::add(Call& call, std::size_t before) {
    const bool moving = std::ranges::any_of(
        demands(), [](const mechanics::MotionState& each) { return each.velocity != 0; });
    if (moves() || moving) {
        call.reject(Reason::State, "the axes are moving: a point is taught at rest");
        return false;
    }
    for (std::size_t i = 0; i < axisCount(); ++i) {
        pose_[i] = nearestInRange(i);
        const bool near = std::abs(observed(i) - pose_[i]) <= overTheEnd;
        if (!near && !inRange(call, "the observed pose", i, observed(i))) return false;
    }
    if (!points_->insert(before, pose_)) {
        call.reject(Reason::Range, "there are 64 points already: remove one first");
        return false;
    }
    pointCount_ = static_cast<std::int64_t>(points_->size());
    return true;
}

Outcome JointTrajectoryController::teach(Call& call) {
    if (!add(call, points_->size())) return Outcome::Rejected;
    call[taught_] = pointCount_.get();
    point_ = pointCount_.get();
    return Outcome::Done;
}

Outcome JointTrajectoryController::insert(Call& call) {
    const std::int64_t at = call[insertAt_];
    if (!isPoint(call, "at", at)) return Outcome::Rejected;
    if (!add(call, static_cast<std::size_t>(at - 1))) return Outcome::Rejected;
    point_ = at;
    return Outcome::Done;
}

Outcome JointTrajectoryController::remove(Call& call) {
    const std::int64_t at = call[removeAt_];
    if (!isPoint(call, "at", at)) return Outcome::Rejected;
    if (moves()) return call.reject(Reason::State, "the axes are moving between points");
    points_->remove(static_cast<std::size_t>(at - 1));
    pointCount_ = static_cast<std::int64_t>(points_->size());
    if (point_ >= at) point_ = point_ - 1;
    return Outcome::Done;
}

Outcome JointTrajectoryController::clear(Call& call) {
    if (moves()) return call.reject(Reason::State, "the axes are moving between points");
    points_->clear();
    pointCount_ = 0;
    point_ = 0;
    return Outcome::Done;
}

Outcome JointTrajectoryController::showPoint(Call& call) {
    const std::int64_t number = call[shown_];
    if (!isPoint(call, "number", number)) return Outcome::Rejected;
    std::ranges::copy((*points_)[static_cast<std::size_t>(number - 1)], call[position_].begin());
    return Outcome::Done;
}

// --- motion -----------------------------------------------------------------------------------

bool JointTrajectoryController::goTo(Call& call, std::int64_t number) {
    point_ = number;
    if (moveTo((*points_)[static_cast<std::size_t>(number - 1)], share_)) return true;
    call.fail("no motion leads to this point");
    return false;
}

// Otherwise it says which axis is how far away.
bool JointTrajectoryController::standsAt(Call& call, std::size_t point) const {
    constexpr double nearBy = 0.05;  // rad or m
    const auto pose = (*points_)[point];
    for (std::size_t i = 0; i < axisCount(); ++i) {
        const double away = std::abs(observed(i) - pose[i]);
        if (away <= nearBy) continue;
        EventText why{demandPath(i)};
        why << " is " << away << " from point 1, more than " << nearBy
            << ": go there first, or state from";
        call.reject(Reason::State, why.view());
        return false;
    }
    return true;
}

bool JointTrajectoryController::begins(Call& call) {
    if (!allFollow(call)) return false;
    const auto count = static_cast<std::int64_t>(points_->size());
    first_ = std::max<std::int64_t>(call[from_], 1);
    last_ = call[to_] == 0 ? count : call[to_].get();
    if (!isPoint(call, "from", first_) || !isPoint(call, "to", last_)) return false;
    return call[from_] != 0 || standsAt(call, 0);
}

// A run may lead backwards, where its last point comes before its first.
Outcome JointTrajectoryController::run(Call& call) {
    if (call.first()) {
        if (!begins(call)) return Outcome::Rejected;
        if (!goTo(call, first_)) return Outcome::Failed;
    }
    const Outcome outcome = proceed(call);
    if (outcome != Outcome::Done) return outcome;
    if (point_ == last_ && !loop_) return Outcome::Done;
    const std::int64_t step = last_ >= first_ ? 1 : -1;
    const bool again = point_ == last_ || point_ + step > pointCount_ || point_ + step < 1;
    if (!goTo(call, again ? first_ : point_ + step)) return Outcome::Failed;
    return Outcome::Running;
}

Outcome JointTrajectoryController::goOn(Call& call, std::int64_t number) {
    if (call.first()) {
        if (points_->size() == 0)
            return call.reject(Reason::State, "there are no points: teach or load some");
        if (!isPoint(call, "the point", number) || !allFollow(call)) return Outcome::Rejected;
        if (!goTo(call, number)) return Outcome::Failed;
    }
    return proceed(call);
}

Outcome JointTrajectoryController::next(Call& call) { return goOn(call, point_ + 1); }

Outcome JointTrajectoryController::previous(Call& call) { return goOn(call, point_ - 1); }

// --- files ------------------------------------------------------------------------------------

// A cancelled one is not waited for: what it leaves is a whole file, or points that nobody takes.
Outcome JointTrajectoryController::work(Call& call, cs::SlowWork& work, bool begins) {
    if (call.cancelling()) return Outcome::Cancelled;
    if (begins && !work.begin()) return call.fail("the last file is not done yet");
    if (work.isRunning()) return Outcome::Running;
    if (!work.failure().empty()) return call.fail(work.failure());
    name_ = files_->name;
    return Outcome::Done;
}

Outcome JointTrajectoryController::save(Call& call) {
    Files& files = *files_;
    const bool begins = call.first();
    if (begins && (files.save.isRunning() || files.load.isRunning()))
        return call.reject(Reason::Busy, "the last file is not done yet");
    if (begins) {
        files.take(call[saveName_]);
        files.points.assign(*points_);
    }
    return work(call, files.save, begins);
}

Outcome JointTrajectoryController::load(Call& call) {
    Files& files = *files_;
    const bool begins = call.first();
    if (begins && moves()) return call.reject(Reason::State, "the axes are moving between points");
    if (begins && (files.save.isRunning() || files.load.isRunning()))
        return call.reject(Reason::Busy, "the last file is not done yet");
    if (begins) files.take(call[loadName_]);
    const Outcome outcome = work(call, files.load, begins);
    if (outcome != Outcome::Done) return outcome;
    points_->assign(files.points);
    pointCount_ = static_cast<std::int64_t>(points_->size());
    point_ = 0;
    return Outcome::Done;
}

void JointTrajectoryController::keep(Archive& archive) {
    AxisPoseController::keep(archive);
    archive.version("JointTrajectoryController", 1);
    archive&* points_& first_ & last_;
}

}  // namespace cortex::toolkit
