// SPDX-License-Identifier: Apache-2.0
#include "handset_playback.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace cortex::toolkit {
namespace {

constexpr double halfStep = 0.5e-3;  // s, for velocities from the path
constexpr double handSpeed = 0.1;    // m/s, by keyboard
constexpr double handTurn = 0.5;     // rad/s
constexpr double smoothTime = 0.05;  // s, from one speed to another

}  // namespace

// A relative path is one from the folder of the file that says so.
std::string HandsetPlayback::pathOfFile() {
    std::filesystem::path file{data<const std::string_view>("file").get()};
    for (const Setting& setting : settings()) {
        if (setting.item == "file" && file.is_relative()) {
            file = std::filesystem::path{setting.place.file}.parent_path() / file;
        }
    }
    return file.string();
}

void HandsetPlayback::populate() {
    if (data<const std::int64_t>("source") == Keyboard) {
        keyboard_ = std::make_unique<KeyboardHand>();
    } else if (const std::string file = pathOfFile(); !file.empty()) {
        path_ = RecordedPath::load(file, data<const bool>("loop") ? PathEnd::Loop : PathEnd::Hold);
    } else {
        throw Error(path() + ": item 'file' is empty: set it to a recorded path, or 'source' to 1");
    }
    poseOutput_ = PoseOutput{output("pose")};
    for (const OutputSimplex& button : outputs("buttons")) {
        buttons_.push_back(button.data<bool>("value"));
    }
    time_ = data<double>("time");
    finished_ = data<bool>("finished");
    if (path_) pose_ = path_->at(0).pose;
    poseOutput_.write(pose_, velocity_);
}

bool HandsetPlayback::stateStartingUp(const Tick& tick) {
    startedAt_ = tick.nominalTime;
    return true;
}

void HandsetPlayback::stateActive(const Tick& tick) {
    time_ = static_cast<double>(tick.nominalTime - startedAt_) * 1e-9;
    if (path_)
        play();
    else
        moveByKeyboard(tick);
}

void HandsetPlayback::play() {
    const PathSample sample = path_->at(time_);
    const double from = std::max(0.0, time_ - halfStep);
    const double to = time_ + halfStep;
    pose_ = sample.pose;
    velocity_ = difference(path_->at(from).pose, path_->at(to).pose) / (to - from);
    finished_ = path_->finished(time_);
    buttons_.front() = sample.trigger;
}

void HandsetPlayback::moveByKeyboard(const Tick& tick) {
    const auto motion = keyboard_->motion(tick.nominalTime);
    const double seconds = tick.elapsedSeconds();
    const double share = std::min(1.0, seconds / smoothTime);
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const double wanted = motion[i] * (i < 3 ? handSpeed : handTurn);
        double& speed = velocity_[static_cast<Eigen::Index>(i)];
        speed += share * (wanted - speed);
    }
    pose_.position += velocity_.head<3>() * seconds;
    const Eigen::Vector3d turn = velocity_.tail<3>() * (seconds / 2);
    const Eigen::Quaterniond step{1, turn.x(), turn.y(), turn.z()};
    pose_.rotation = (step * pose_.rotation).normalized();
    buttons_.front() = keyboard_->pressed();
}

// The pose is measured in every state; buttons count as released unless Active.
void HandsetPlayback::loopEnd(const Tick&) {
    if (state() != State::Active) {
        velocity_.setZero();
        for (Data<bool>& button : buttons_) button = false;
    }
    poseOutput_.write(pose_, velocity_);
}

void HandsetPlayback::keep(Archive& archive) {
    archive.version("HandsetPlayback", 2);
    archive.time(startedAt_);
    toolkit::keep(archive, pose_);
    toolkit::keep(archive, velocity_);
}

}  // namespace cortex::toolkit
