// SPDX-License-Identifier: Apache-2.0
#include "conform/ds402_words.hpp"

#include <algorithm>
#include <optional>

namespace cortex::cli::conform {
namespace {

constexpr std::int64_t staysFrom = 5;  // of quickStopOption
constexpr std::size_t mostSteps = 6;

// The word on the way from one state to another; none: there is none, or it is there.
std::optional<Word> next(Drive from, Drive to) {
    using enum Drive;
    if (from == to) return {};
    switch (from) {
        case SwitchOnDisabled:
            return Word::Shutdown;
        case ReadyToSwitchOn:
            return to == SwitchOnDisabled ? Word::DisableVoltage : Word::SwitchOn;
        case SwitchedOn:
            if (to == SwitchOnDisabled) return Word::DisableVoltage;
            return to == ReadyToSwitchOn ? Word::Shutdown : Word::EnableOperation;
        case OperationEnabled:
            if (to == SwitchOnDisabled) return Word::DisableVoltage;
            if (to == ReadyToSwitchOn) return Word::Shutdown;
            return to == QuickStopActive ? Word::QuickStop : Word::DisableOperation;
        case QuickStopActive:
            return Word::DisableVoltage;
        case Fault:
            return Word::FaultReset;
        default:
            return {};
    }
}

}  // namespace

bool isPossible(Drive state, Word word) {
    const auto isIt = [&](const Transition& each) {
        return each.from == state && each.word == word;
    };
    if (std::ranges::any_of(transitions, isIt)) return true;
    if (word == Word::QuickStop)
        return state == Drive::ReadyToSwitchOn || state == Drive::SwitchedOn;
    if (word == Word::FaultReset) return state == Drive::Fault;
    // Some drives go on from Ready to switch on by themselves.
    return word == Word::EnableOperation && state == Drive::ReadyToSwitchOn;
}

bool hasTorque(Drive state) {
    return state == Drive::OperationEnabled || state == Drive::QuickStopActive;
}

DriveAxis::DriveAxis(Bench& bench, const AxisPair& axis, bool withTorque)
    : bench_{bench}, axis_{axis}, processor_{bench.plant().processor.value_or(noSimplex)} {
    const std::string& path = bench.plant().path(processor_);
    if (bench.now().stateOf(processor_) != State::Standby) {
        throw Ended{skipped(path + " is in " + stateText(bench.now(), processor_) +
                            "; bring it to Standby first: cortex call " + path + " shutdown")};
    }
    const Drive is = state();
    if (hasTorque(is)) {
        throw Ended{skipped("its drive is in " + text(is) + " while " + path +
                            " is in Standby; find out who leads it")};
    }
    if (is == Drive::Unknown || is == Drive::Fault || is == Drive::FaultReactionActive) {
        throw Ended{skipped("its drive is in " + text(is) +
                            "; look at its link and at errorText of " + path +
                            ", and call resetFault")};
    }
    if (!withTorque) return;
    bench.bring(processor_, State::Active);
    bench.bring(bench.plant().device, State::Active);
}

Drive DriveAxis::stateIn(const Sample& sample) const {
    const std::int64_t told = sample.count(axis_.observation, "driveState");
    const bool isSeen = sample.count(processor_, "driveState", axis_.place) == told;
    return isSeen ? static_cast<Drive>(told) : Drive::Unknown;
}

Drive DriveAxis::state() const {
    const auto isKnown = [&](const Sample& each) { return stateIn(each) != Drive::Unknown; };
    bench_.recording().becomes(isKnown, stepTime());
    return stateIn(bench_.now());
}

double DriveAxis::stepTime() const {
    return 2 * bench_.now().number(processor_, "stepTimeout").value_or(1);
}

std::string DriveAxis::text(Drive state) const {
    return bench_.label(axis_.observation, "driveState", static_cast<std::int64_t>(state));
}

std::string DriveAxis::text(Word word) const {
    const Command* step = bench_.plant().type(processor_).findCommand("step");
    for (const DataItem& each : step == nullptr ? std::vector<DataItem>{} : step->request) {
        const auto label = each.labels.find(static_cast<std::int64_t>(word));
        if (label != each.labels.end()) return label->second;
    }
    return std::to_string(static_cast<int>(word));
}

comms::CommandAnswer DriveAxis::step(Word word) {
    return bench_.call(processor_, "step",
                       {{"axis", static_cast<std::int64_t>(axis_.place + 1)},
                        {"word", static_cast<std::int64_t>(word)}});
}

bool DriveAxis::becomes(Drive state) {
    return bench_.recording().becomes([&](const Sample& each) { return stateIn(each) == state; },
                                      stepTime());
}

void DriveAxis::lead(Drive to) {
    for (std::size_t steps = 0; state() != to; ++steps) {
        const Drive from = state();
        const auto word = next(from, to);
        if (!word || steps == mostSteps)
            throw Ended{failed("no words lead from " + text(from) + " to " + text(to))};
        const comms::CommandAnswer answer = step(*word);
        const bool left = bench_.recording().becomes(
            [&](const Sample& each) {
                return stateIn(each) != from && stateIn(each) != Drive::Unknown;
            },
            stepTime());
        if (left) continue;
        throw Ended{failed("in " + text(from) + " the word " + text(*word) +
                           " did nothing on the way to " + text(to) + ": " + answer.text())};
    }
}

bool DriveAxis::quickStopStays() const {
    return bench_.now().count(processor_, "quickStopOption", axis_.place) >= staysFrom;
}

}  // namespace cortex::cli::conform
