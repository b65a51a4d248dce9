// SPDX-License-Identifier: Apache-2.0
// What a CiA 402 drive and its processor have to do together.
#include "conform/ds402_words.hpp"
#include "conform/tests.hpp"

#include <algorithm>
#include <array>

namespace cortex::cli::conform {
namespace {

constexpr std::int64_t stays = 5;  // a quickStopOption
constexpr double echoTime = 2;     // s
constexpr double stillTime = 0.2;  // s in which a refused word has no effect

const AxisPair& axisAt(Bench& bench, std::size_t place) {
    if (!bench.plant().processor) {
        throw Ended{skipped("no Ds402Processor of agent " + bench.plant().agent +
                            " has its observations as drives; add one, and relate both")};
    }
    const AxisPair& axis = bench.plant().axes.at(place);
    bench.needGood(axis.observation);
    return axis;
}

// An axis that is led back to where it was at the end, also where the test fails.
DriveAxis leadAxis(Bench& bench, std::size_t place, bool withTorque) {
    const AxisPair& pair = axisAt(bench, place);
    const Drive found = DriveAxis{bench, pair, false}.state();
    DriveAxis axis{bench, pair, withTorque};
    bench.undoAtRest([axis, before = found]() mutable {
        try {
            axis.lead(before);
        } catch (const Ended&) {
            return;  // it is in a fault, or its link is gone
        }
    });
    return axis;
}

std::uint32_t setpointOf(const Bench& bench, const AxisPair& axis) {
    const auto setpoints = bench.plant().related(*bench.plant().processor, "setpoints");
    return axis.place < setpoints.size() ? setpoints[axis.place] : noSimplex;
}

// "": the drive shows the mode that is wished; otherwise what is wrong.
std::string echoes(Bench& bench, const AxisPair& axis) {
    const std::uint32_t setpoint = setpointOf(bench, axis);
    const auto isEchoed = [&](const Sample& each) {
        return each.count(axis.observation, "modeDisplay") == each.count(setpoint, "mode");
    };
    if (bench.recording().becomes(isEchoed, echoTime)) return {};
    const Sample now = bench.now();
    return "mode " + bench.label(setpoint, "mode", now.count(setpoint, "mode")) +
           " was wished for 2 s, and modeDisplay of " + bench.plant().path(axis.observation) +
           " is " +
           bench.label(axis.observation, "modeDisplay",
                       now.count(axis.observation, "modeDisplay")) +
           "; does the drive tell 6061h, and know this mode?";
}

Judgement modeEcho(Bench& bench, std::size_t place) {
    const AxisPair& axis = axisAt(bench, place);
    const std::uint32_t processor = *bench.plant().processor, setpoint = setpointOf(bench, axis);
    if (setpoint == noSimplex) return failed("its processor has no setpoints for it");
    const std::int64_t before = bench.now().count(setpoint, "mode");
    if (std::string wrong = echoes(bench, axis); !wrong.empty()) return failed(wrong);
    const Drive state{bench.now().count(axis.observation, "driveState")};
    if (hasTorque(state) || bench.now().stateOf(processor) != State::Standby)
        return passed("only the present mode, as " + bench.plant().path(processor) +
                      " is not in Standby");
    const auto number = static_cast<std::int64_t>(axis.place + 1);
    bench.undoLater([&bench, processor, number, before] {
        bench.quietly(processor, "setMode", {{"axis", number}, {"mode", before}});
    });
    std::vector<std::string> modes;
    for (const std::int64_t mode : {1, 3, 9, 10, 8}) {
        const auto answer = bench.call(processor, "setMode", {{"axis", number}, {"mode", mode}});
        if (!answer.done()) continue;  // not built, or not by this drive
        bench.recording().pass(stillTime);
        if (std::string wrong = echoes(bench, axis); !wrong.empty()) return failed(wrong);
        if (bench.now().count(setpoint, "mode") == mode)
            modes.push_back(bench.label(setpoint, "mode", mode));
    }
    return passed(modes.empty() ? "no mode but the present one is taken" : joined(modes));
}

// Options 5 to 8 let a drive stay in Quick stop active; where it has another one, it gets 5 as long
// as this test takes.
Judgement goesOnAfterQuickStop(Bench& bench, std::size_t place) {
    const AxisPair& pair = axisAt(bench, place);
    const std::uint32_t processor = *bench.plant().processor;
    if (!DriveAxis{bench, pair, false}.quickStopStays()) {
        const auto now = bench.value(processor, "quickStopOption");
        auto options = std::get<std::vector<std::int64_t>>(now.value());
        options.at(pair.place) = stays;
        bench.set(processor, "quickStopOption", options);
    }
    DriveAxis axis = leadAxis(bench, place, true);
    axis.lead(Drive::OperationEnabled);
    axis.step(Word::QuickStop);
    bench.recording().pass(stillTime);
    if (!axis.becomes(Drive::QuickStopActive))
        return skipped("it leaves Quick stop active by itself, also with quickStopOption 5");
    const auto answer = axis.step(Word::EnableOperation);
    if (axis.becomes(Drive::OperationEnabled)) return passed("QuickStopActive to OperationEnabled");
    return failed("EnableOperation in QuickStopActive led to " + axis.text(axis.state()) +
                  ", OperationEnabled was expected; the answer was " + answer.text());
}

Judgement makesTransition(Bench& bench, std::size_t place, const Transition& wanted) {
    if (wanted.number == 16) return goesOnAfterQuickStop(bench, place);
    DriveAxis axis = leadAxis(bench, place, hasTorque(wanted.from) || hasTorque(wanted.to));
    const bool itStays = axis.quickStopStays();
    const bool byItself = wanted.number == 12 && !itStays;
    axis.lead(byItself ? Drive::OperationEnabled : wanted.from);
    const auto count = [&] {
        return bench.now().count(axis.processor(), "transitionCount", axis.place());
    };
    const std::int64_t before = count();
    const auto answer = axis.step(byItself ? Word::QuickStop : wanted.word);
    const bool came = axis.becomes(wanted.to) ||
                      (wanted.number == 11 && !itStays && axis.becomes(Drive::SwitchOnDisabled));
    const std::string step = axis.text(byItself ? Word::QuickStop : wanted.word);
    if (!came) {
        return failed(step + " in " + axis.text(wanted.from) + " led to " +
                      axis.text(axis.state()) + ", " + axis.text(wanted.to) +
                      " was expected; the answer was " + answer.text());
    }
    const auto isCounted = [&](const Sample& each) {
        return each.count(axis.processor(), "transitionCount", axis.place()) > before;
    };
    if (!bench.recording().becomes(isCounted, stillTime))
        return failed("the drive made it, but transitionCount of " +
                      bench.plant().path(axis.processor()) + " stayed at " +
                      std::to_string(before));
    return passed(axis.text(wanted.from) + " to " + axis.text(wanted.to));
}

Judgement refusesWords(Bench& bench, std::size_t place, Drive state) {
    DriveAxis axis = leadAxis(bench, place, hasTorque(state));
    axis.lead(state);
    const auto count = [&] {
        return bench.now().count(axis.processor(), "transitionCount", axis.place());
    };
    const std::int64_t before = count();
    std::vector<std::string> refused;
    for (const Word word : allWords) {
        if (isPossible(state, word)) continue;
        const auto answer = axis.step(word);
        if (answer.outcome != Outcome::Rejected)
            return failed("step(" + axis.text(word) + ") in " + axis.text(state) +
                          " is no transition of CiA 402 and was not rejected: " + answer.text());
        refused.push_back(axis.text(word));
    }
    bench.recording().pass(stillTime);
    if (axis.state() == state && count() == before) return passed(joined(refused));
    return failed("after " + joined(refused) + " were refused, the drive went from " +
                  axis.text(state) + " to " + axis.text(axis.state()) +
                  "; a refused word must not reach it");
}

Judgement homes(Bench& bench, std::size_t place) {
    const AxisPair& axis = axisAt(bench, place);
    const std::uint32_t processor = *bench.plant().processor;
    if (bench.constant(axis.observation, "homingNeeded") == 0)
        return skipped("homingNeeded of " + bench.plant().path(axis.observation) + " is false");
    bench.bring(processor, State::Active);
    bench.bring(bench.plant().device, State::Active);
    bench.undoLater([&bench, processor] { bench.quietly(processor, "cancel"); });
    constexpr double timeout = 120;
    const auto answer = bench.call(
        processor, "home",
        {{"axis", static_cast<std::int64_t>(axis.place + 1)}, {"timeout", timeout}}, timeout);
    if (!answer.done())
        return failed("homing ended with " + answer.text() + bench.faultText(processor));
    const auto isHomed = [&](const Sample& each) {
        return each.at(axis.observation, "homed") != 0;
    };
    if (bench.recording().becomes(isHomed, echoTime)) return passed();
    return failed("homing is done, but homed of " + bench.plant().path(axis.observation) +
                  " is false");
}

Judgement watchdogTrips(Bench&, std::size_t) {
    return skipped(
        "this test is not built: stop the agent while the axis moves, and see that the "
        "drive does what onControllerLoss says");
}

Needs needsFor(Drive from, Drive to) {
    return hasTorque(from) || hasTorque(to) ? Needs::Motion : Needs::Nothing;
}

}  // namespace

Tests ds402Tests() {
    const std::vector<std::string> drive{"Ds402Device"};
    Tests tests{{"mode is echoed", drive, Needs::Nothing, Per::Axis, modeEcho}};
    for (const Transition& each : transitions) {
        tests.push_back({"transition " + std::to_string(each.number), drive,
                         needsFor(each.from, each.to), Per::Axis,
                         [each](Bench& bench, std::size_t place) {
                             return makesTransition(bench, place, each);
                         }});
    }
    const std::array states{std::pair{Drive::SwitchOnDisabled, "Switch on disabled"},
                            std::pair{Drive::ReadyToSwitchOn, "Ready to switch on"},
                            std::pair{Drive::SwitchedOn, "Switched on"},
                            std::pair{Drive::OperationEnabled, "Operation enabled"}};
    for (const auto& each : states) {
        tests.push_back({std::string{"words refused: "} + each.second, drive,
                         needsFor(each.first, each.first), Per::Axis,
                         [state = each.first](Bench& bench, std::size_t place) {
                             return refusesWords(bench, place, state);
                         }});
    }
    tests.push_back({"homing finds its zero", drive, Needs::Homing, Per::Axis, homes});
    tests.push_back({"its watchdog trips", drive, Needs::Nothing, Per::Device, watchdogTrips});
    return tests;
}

}  // namespace cortex::cli::conform
