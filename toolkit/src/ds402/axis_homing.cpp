// SPDX-License-Identifier: Apache-2.0
#include "ds402/axis_homing.hpp"

#include "ds402/transition_lead.hpp"

namespace cortex::toolkit {

using drives::Ds402Homing;

void AxisHoming::go(Phase phase) {
    phase_ = phase;
    spent_ = 0;
}

void AxisHoming::begin() {
    result_ = Result::None;
    moved_ = false;
    go(Phase::Enter);
}

void AxisHoming::stop(Result why) {
    if (!runs()) return;
    if (result_ == Result::None) result_ = why;
    if (phase_ != Phase::Leave) go(Phase::Brake);
}

void AxisHoming::abort(Result why) {
    if (!runs()) return;
    result_ = why;
    go(Phase::Idle);
}

// Bits that stand when it begins may be those of the last time.
void AxisHoming::search(Ds402Homing status, double timeout) {
    if (spent_ < ds402ExchangeTime) return;
    switch (status) {
        case Ds402Homing::Done:
            return stop(Result::Done);
        case Ds402Homing::Error:
            return stop(Result::Failed);
        case Ds402Homing::NotStarted:
            if (moved_) return stop(Result::Interrupted);
            if (spent_ > timeout) stop(Result::NotBegun);
            return;
        case Ds402Homing::Runs:
        case Ds402Homing::AttainedButMoving:
        case Ds402Homing::ErrorMoving:
            moved_ = true;
    }
}

void AxisHoming::advance(const Seen& seen, double seconds, double timeout) {
    spent_ += seconds;
    switch (phase_) {
        case Phase::Idle:
            return;
        case Phase::Enter:
            if (seen.mode == ds402HomingMode)
                go(Phase::Search);
            else if (spent_ > timeout)
                stop(Result::ModeRefused);
            return;
        case Phase::Search:
            return search(seen.status, timeout);
        case Phase::Brake:
            if (seen.stands && seen.targetsThere && !seen.demandMoves) go(Phase::Leave);
            return;
        case Phase::Leave:
            if (seen.mode == seen.modeBefore) return go(Phase::Idle);
            if (spent_ > timeout) abort(Result::ModeKept);
    }
}

double AxisHoming::share() const {
    switch (phase_) {
        case Phase::Idle:
            return 1;
        case Phase::Enter:
            return 0;
        case Phase::Search:
            return 0.1;
        case Phase::Brake:
            return 0.8;
        case Phase::Leave:
            return 0.9;
    }
    return 0;
}

std::string_view AxisHoming::words(Result result) {
    switch (result) {
        case Result::None:
        case Result::Done:
            return {};
        case Result::Failed:
            return "the drive says that homing has failed";
        case Result::Interrupted:
            return "the drive has interrupted homing";
        case Result::NotBegun:
            return "the drive did not begin with homing";
        case Result::TimedOut:
            return "the zero position was not found in time";
        case Result::Cancelled:
            return "homing was cancelled";
        case Result::Stopped:
            return "the axis was stopped meanwhile";
        case Result::ModeRefused:
            return "the drive does not go into the mode homing";
        case Result::ModeKept:
            return "the drive does not come back from the mode homing";
    }
    return {};
}

}  // namespace cortex::toolkit
