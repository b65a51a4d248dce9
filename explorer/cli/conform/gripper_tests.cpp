// SPDX-License-Identifier: Apache-2.0
// What a gripper has to do, whoever moves its axis: a GripperController commands it.
#include "conform/motion.hpp"
#include "conform/tests.hpp"

#include <cmath>
#include <cstdint>
#include <string>

namespace cortex::cli::conform {
namespace {

constexpr double tolerance = 0.001;  // m, of an opening
constexpr double patience = 60;      // s, for one way of the jaws
constexpr double jawsSettle = 2;     // s
constexpr double holdTime = 2;       // s that a work piece is looked at

class Jaws {
public:
    Jaws(Bench& bench, std::size_t place)
        : bench_{bench}, axis_{bench.plant().axes.at(place)}, controller_{controllerOf(bench)} {
        bench_.needGood(axis_.observation);
        const double before = width();
        bench_.bring(controller_, State::Active);
        if (bench_.plant().processor) bench_.bring(*bench_.plant().processor, State::Active);
        bench_.bring(bench_.plant().device, State::Active);
        bench_.undoLater([&bench, before, controller = controller_] {
            bench.call(controller, "moveTo", {{"width", before}}, patience);
        });
    }

    double width() const { return bench_.now().at(axis_.observation, "position"); }
    AxisBounds bounds() const { return boundsOf(bench_.plant().type(axis_.demand)); }
    // What is between the jaws, or as far as they close.
    double between() const { return std::max(bounds().least, bench_.wishes().grip.value_or(0)); }
    bool holds(const Sample& each) const {
        return each.count(controller_, "object") == stoppedClosing;
    }

    comms::CommandAnswer call(const std::string& command, const Bench::Arguments& arguments = {}) {
        return bench_.call(controller_, command, arguments, patience);
    }
    bool comesTo(double wanted) {
        return bench_.recording().becomes(
            [&](const Sample& each) {
                return std::abs(each.at(axis_.observation, "position") - wanted) <= tolerance;
            },
            jawsSettle);
    }
    // Throws Ended where it does not come there.
    void moves(const std::string& command, double wanted) {
        const comms::CommandAnswer answer = call(command);
        if (!answer.done())
            throw Ended{failed(command + " ended with " + answer.text() +
                               bench_.faultText(bench_.plant().device))};
        if (comesTo(wanted)) return;
        throw Ended{failed("after " + command + " the opening is " + with(width()) + ", and " +
                           with(wanted) + " was expected; is something between the jaws?")};
    }
    static std::string with(double metres) { return numberText(metres * 1000) + " mm"; }

private:
    static constexpr std::int64_t stoppedClosing = 2;  // label of `object`

    std::uint32_t controllerOf(Bench& bench) const {
        for (const Mover& each : bench.plant().movers(axis_)) {
            if (each.kind == Mover::Grips) return each.controller;
        }
        throw Ended{skipped("no GripperController of agent " + bench.plant().agent + " writes " +
                            bench.plant().path(axis_.demand))};
    }

    Bench& bench_;
    const AxisPair axis_;
    const std::uint32_t controller_;
};

Judgement opensAndCloses(Bench& bench, std::size_t place) {
    Jaws jaws{bench, place};
    jaws.moves("open", jaws.bounds().most);
    jaws.moves("close", jaws.between());
    jaws.moves("open", jaws.bounds().most);
    return passed(Jaws::with(jaws.between()) + " to " + Jaws::with(jaws.bounds().most));
}

Judgement tellsOfNothing(Jaws& jaws) {
    const comms::CommandAnswer answer = jaws.call("grip");
    if (answer.done())
        return failed("grip is done with " + Jaws::with(jaws.width()) +
                      " between the jaws, and nothing should be there; --grip WIDTH says what is");
    if (!jaws.comesTo(jaws.bounds().least))
        return failed("grip ended with " + answer.text() + " at " + Jaws::with(jaws.width()) +
                      "; with nothing between them the jaws close");
    return passed("nothing is there, and it says so");
}

Judgement grips(Bench& bench, std::size_t place) {
    Jaws jaws{bench, place};
    jaws.moves("open", jaws.bounds().most);
    if (bench.wishes().grip.value_or(0) == 0) return tellsOfNothing(jaws);
    const comms::CommandAnswer answer = jaws.call("grip");
    if (!answer.done())
        return failed("grip ended with " + answer.text() + bench.faultText(bench.plant().device));
    bool held = true;
    const double gripped = jaws.width();
    bench.recording().follow([&](const Sample& each) { held = held && jaws.holds(each); });
    bench.recording().pass(holdTime);
    bench.recording().follow({});
    if (std::abs(gripped - jaws.between()) > tolerance)
        return failed("it gripped at " + Jaws::with(gripped) + ", and the work piece has " +
                      Jaws::with(jaws.between()));
    if (!held || std::abs(jaws.width() - gripped) > tolerance)
        return failed("it gripped, and did not hold the work piece for 2 s; the opening is " +
                      Jaws::with(jaws.width()));
    jaws.moves("open", jaws.bounds().most);
    return passed("holds " + Jaws::with(gripped));
}

}  // namespace

Tests gripperTests() {
    return {{"opens and closes", {"Device"}, Needs::Grip, Per::Axis, opensAndCloses},
            {"grips", {"Device"}, Needs::Grip, Per::Axis, grips}};
}

}  // namespace cortex::cli::conform
