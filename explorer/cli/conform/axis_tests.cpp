// SPDX-License-Identifier: Apache-2.0
// What a device that moves axes has to do. All judge one trial, in which the axis was moved once.
#include "conform/motion.hpp"
#include "conform/tests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace cortex::cli::conform {
namespace {

constexpr double tooFast = 1.1;  // of the greatest speed, for what was measured
constexpr double window = 0.1;   // s over which a speed is taken from positions
constexpr double scale = 0.1;    // that a way may be too long or too short

struct Judged {
    const Trial& trial;
    Bench& bench;
    const AxisPair& axis;

    std::string with(double number) const { return numberText(number) + " " + trial.unit; }
    const std::string& demand() const { return bench.plant().path(axis.demand); }
    const std::string& observation() const { return bench.plant().path(axis.observation); }
};

[[noreturn]] void endWith(const Trial& trial) {
    const Judgement why = trial.ended.value_or(failed("it was not reached"));
    if (why.verdict == Verdict::Skipped) throw Ended{why};
    throw Ended{skipped("the axis was not moved so far; see 'it moves on command'")};
}

const Trial::Leg& firstLeg(const Trial& trial) {
    if (trial.legs.empty() || trial.points.empty()) endWith(trial);
    return trial.legs.front();
}

Judgement movesOnCommand(const Judged& of) {
    if (of.trial.ended) return *of.trial.ended;
    return passed("by " + of.trial.controller);
}

Judgement startsWhereItIs(const Judged& of) {
    if (!of.trial.startGap) {
        if (of.trial.legs.empty()) endWith(of.trial);
        return skipped("it was found Active, and not started");
    }
    const double gap = std::abs(*of.trial.startGap);
    if (gap <= of.trial.near) return passed(of.with(gap) + " apart");
    return failed(of.demand() + " was " + of.with(gap) + " away from " + of.observation() +
                  " when power came on; a demand begins where the axis is: safe=\"observed\" or "
                  "\"stop\", and the device waits for it in StartingUp");
}

Judgement sign(const Judged& of) {
    const Trial::Leg& leg = firstLeg(of.trial);
    const double moved = leg.reached - leg.from;
    if (moved > of.trial.near) return passed();
    if (moved >= -of.trial.near)
        return failed(of.observation() + " did not move: " + of.with(of.trial.amplitude) +
                      " were demanded; is it braked, blocked or without power?");
    return failed(of.observation() + " went " + of.with(moved) + " where " +
                  of.with(of.trial.amplitude) +
                  " were demanded: the sign of the demand or of the observation is wrong in the "
                  "device");
}

std::string unitHint(double ratio) {
    struct Hint {
        double ratio;
        const char* text;
    };
    constexpr double degrees = 57.29577951308232;
    for (const Hint& each :
         std::array<Hint, 6>{{{degrees, "degrees where radians are meant"},
                              {1 / degrees, "radians where degrees are meant"},
                              {1000, "millimetres where metres are meant"},
                              {0.001, "metres where millimetres are meant"},
                              {2 * 3.14159265358979, "turns taken for radians"},
                              {1 / 6.28318530717959, "radians taken for turns"}}}) {
        if (std::abs(ratio / each.ratio - 1) <= scale) return std::string{": "} + each.text;
    }
    return "; look at gear, pitch and countsPerUnit";
}

Judgement unit(const Judged& of) {
    const Trial::Leg& leg = firstLeg(of.trial);
    const double ratio = std::abs(leg.reached - leg.from) / of.trial.amplitude;
    if (std::abs(ratio - 1) <= scale) return passed();
    return failed("its way was " + numberText(ratio) + " times as long as was demanded" +
                  unitHint(ratio));
}

Judgement arrives(const Judged& of) {
    firstLeg(of.trial);
    for (const Trial::Leg& each : of.trial.legs) {
        if (!each.answer.empty())
            return failed("the motion to " + of.with(each.to) + " ended with " + each.answer);
        if (!each.arrived)
            return failed(of.observation() + " is at " + of.with(each.reached) +
                          ", and not within " + of.with(of.trial.near) + " of " + of.with(each.to) +
                          ", 2 s after its demand was there");
    }
    return passed("within " + of.with(of.trial.near) + ", " +
                  plural(of.trial.legs.size(), "motion"));
}

Judgement follows(const Judged& of) {
    firstLeg(of.trial);
    double most = 0;
    for (const Trial::Point& each : of.trial.points) {
        most = std::max(most, std::abs(each.demanded - each.observed));
    }
    const double stated =
        of.bench.constant(of.bench.plant().device, "followingErrorWindow", of.axis.place);
    const double limit = stated > 0 ? stated : of.trial.amplitude / 2;
    if (most <= limit) return passed("at most " + of.with(most));
    return failed("demand and observation were " + of.with(most) + " apart, at most " +
                  of.with(limit) +
                  (stated > 0 ? " are stated (followingErrorWindow)"
                              : " are expected (half of the amplitude)") +
                  "; is it slow, loaded, or told old demands?");
}

// From one point to the last one that is long enough ago.
double greatestSpeed(const std::vector<Trial::Point>& points) {
    double most = 0;
    std::size_t from = 0;
    for (const Trial::Point& each : points) {
        while (each.seconds - points[from + 1].seconds >= window) ++from;
        const double time = each.seconds - points[from].seconds;
        if (time < window) continue;
        most = std::max(most, std::abs(each.observed - points[from].observed) / time);
    }
    return most;
}

Judgement keepsLimits(const Judged& of) {
    firstLeg(of.trial);
    const AxisBounds bounds = boundsOf(of.bench.plant().type(of.axis.demand));
    double speed = 0, least = of.trial.points.front().observed, most = least;
    for (const Trial::Point& each : of.trial.points) {
        if (!std::isfinite(each.observed) || !std::isfinite(each.speed))
            return failed(of.observation() + " said on its way that it is at " +
                          of.with(each.observed) + " and moves at " + of.with(each.speed) + "/s");
        speed = std::max(speed, std::abs(each.speed));
        least = std::min(least, each.observed);
        most = std::max(most, each.observed);
    }
    for (const double each : {least, most}) {
        if (each >= bounds.least && each <= bounds.most) continue;
        return failed(of.observation() + " was at " + of.with(each) + ", outside of " +
                      of.with(bounds.least) + " to " + of.with(bounds.most) +
                      ", which its demand kept; the device itself must not go beyond its range");
    }
    const double way = of.trial.points.size() < 2 ? 0 : greatestSpeed(of.trial.points);
    if (std::max(speed, way) <= tooFast * bounds.speed)
        return passed("at most " + of.with(std::max(speed, way)) + "/s");
    return failed(of.observation() + " moved at " + of.with(std::max(speed, way)) + "/s, and " +
                  of.with(bounds.speed) +
                  "/s are allowed; does the velocity have another unit, or "
                  "does the device not keep its limit?");
}

// The way that its velocity adds up to, until its first demand was there.
Judgement velocityIsThatOfItsPosition(const Judged& of) {
    firstLeg(of.trial);
    const auto& points = of.trial.points;
    const auto there = std::ranges::max_element(points, {}, &Trial::Point::demanded);
    double added = 0;
    for (auto each = points.begin(); each != there; ++each) {
        const auto next = each + 1;
        added += (each->speed + next->speed) / 2 * (next->seconds - each->seconds);
    }
    const double way = there->observed - points.front().observed;
    if (std::abs(added - way) <= scale * std::abs(way) + of.trial.near)
        return passed(of.with(added) + " for " + of.with(way));
    return failed(of.observation() + " went " + of.with(way) + ", and its velocity adds up to " +
                  of.with(added) +
                  ": whoever brakes or judges a standstill by it is misled; does it come from the "
                  "device, and in another unit?");
}

// A drive says when it measured, and its acceleration is taken from that.
Judgement accelerationChanges(const Judged& of) {
    firstLeg(of.trial);
    const auto& points = of.trial.points;
    const auto [least, most] = std::ranges::minmax(points, {}, &Trial::Point::speed);
    if (most.speed - least.speed <= of.trial.near)
        return skipped("its velocity did not change; see 'velocity is that of its position'");
    if (std::ranges::any_of(points, [](const auto& each) { return each.acceleration != 0; }))
        return passed();
    return failed(of.observation() + " changed its velocity by " +
                  of.with(most.speed - least.speed) +
                  "/s, and its acceleration stayed 0: does the drive's clock stand, or is the item "
                  "never written?");
}

Judgement stopsWithoutDemand(const Judged& of) {
    if (!of.trial.loss) {
        if (of.trial.legs.size() < 3) endWith(of.trial);
        return skipped(
            "the motion ended before its controller could be shut down; give a greater "
            "amplitude or a smaller --speed");
    }
    const Trial::Loss& loss = *of.trial.loss;
    if (!loss.came)
        return failed(of.observation() + " still moves 2 s after " + of.trial.controller +
                      " was shut down; what does the device do with a demand that is stale?");
    if (loss.rest > loss.target + of.trial.near)
        return failed("it went on to " + of.with(loss.rest) + ", beyond " + of.with(loss.target) +
                      ", after " + of.trial.controller + " was shut down at " + of.with(loss.at));
    return passed("at rest after " + numberText(loss.seconds) + " s, " +
                  of.with(std::abs(loss.rest - loss.at)) + " farther");
}

Judgement isBraked(const Judged& of) {
    if (!of.trial.brake) {
        if (of.trial.ended) endWith(of.trial);
        return skipped("it was found Active, and not shut down");
    }
    const Trial::Brake& brake = *of.trial.brake;
    if (!brake.isOn)
        return failed("in Standby the status of " + of.observation() + " is " + brake.status +
                      "; Braked or Disabled was expected");
    if (brake.drift > of.trial.near)
        return failed("in Standby it moved by " + of.with(brake.drift) +
                      " within 0.5 s; look at its brake");
    return passed(brake.status + ", drift " + of.with(brake.drift));
}

}  // namespace

Tests axisTests() {
    struct Row {
        const char* name;
        Judgement (*judge)(const Judged&);
        const char* type = "Device";
    };
    Tests tests;
    for (const Row& row :
         std::array<Row, 11>{{{"it moves on command", movesOnCommand},
                              {"it starts where it is", startsWhereItIs},
                              {"sign is right", sign},
                              {"unit is right", unit},
                              {"it arrives", arrives},
                              {"it follows its demand", follows},
                              {"limits are kept", keepsLimits},
                              {"velocity is that of its position", velocityIsThatOfItsPosition},
                              {"acceleration changes", accelerationChanges, "Ds402Device"},
                              {"it stops without a demand", stopsWithoutDemand},
                              {"it is braked in Standby", isBraked}}}) {
        tests.push_back({row.name,
                         {row.type},
                         Needs::Motion,
                         Per::Axis,
                         [judge = row.judge](Bench& bench, std::size_t place) {
                             const AxisPair& axis = bench.plant().axes.at(place);
                             return judge({trialOf(bench, axis), bench, axis});
                         }});
    }
    return tests;
}

}  // namespace cortex::cli::conform
