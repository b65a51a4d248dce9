// SPDX-License-Identifier: Apache-2.0
// What every device has to do.
#include "common/number_text.hpp"
#include "conform/tests.hpp"

#include <algorithm>
#include <set>

namespace cortex::cli::conform {
namespace {

constexpr double goodTime = 2;    // s
constexpr double lookTime = 0.5;  // s, at least, that stamps are looked at

// The first thing of a type that has no description; "": none.
std::string undescribed(const Type& type) {
    if (type.description.empty()) return "type " + type.name;
    for (const DataItem& each : type.data) {
        if (each.description.empty()) return "item " + each.name + " of " + type.name;
    }
    for (const Command& command : type.commands) {
        if (command.description.empty()) return "command " + command.name + " of " + type.name;
        for (const auto* parameters : {&command.request, &command.response}) {
            for (const DataItem& each : *parameters) {
                if (each.description.empty())
                    return "parameter " + each.name + " of " + command.name + " of " + type.name;
            }
        }
    }
    for (const Rule& each : type.rules) {
        if (each.description.empty()) return "rule " + each.name + " of " + type.name;
    }
    return {};
}

// The first rule that has too few or too many relationships; "": none.
std::string wrongCount(const Plant& plant, std::uint32_t simplex) {
    for (const Rule& rule : plant.type(simplex).rules) {
        const std::size_t count = plant.related(simplex, rule.name).size();
        if (count >= rule.min && count <= rule.max) continue;
        return "rule " + rule.name + " of " + plant.path(simplex) + " has " +
               std::to_string(count) + ", and takes " + std::to_string(rule.min) + " to " +
               (rule.max == Rule::many ? "any number" : std::to_string(rule.max));
    }
    return {};
}

Judgement typesAndRules(Bench& bench, std::size_t) {
    const Plant& plant = bench.plant();
    std::set<std::string> types;
    std::size_t rules = 0;
    for (const std::uint32_t each : plant.all()) {
        const Type& type = plant.type(each);
        types.insert(type.name);
        rules += type.rules.size();
        if (const std::string what = undescribed(type); !what.empty())
            return failed(what +
                          " has no description; a person who meets it has nothing else: "
                          "write what it is and does");
        if (const std::string what = wrongCount(plant, each); !what.empty()) return failed(what);
    }
    return passed(plural(types.size(), "type") + " and " + plural(rules, "rule"));
}

Judgement controllerLoss(Bench& bench, std::size_t) {
    const std::uint32_t device = bench.plant().device;
    const auto says = static_cast<std::int64_t>(bench.constant(device, "onControllerLoss"));
    const double time = bench.constant(device, "controllerLossTime");
    if (says != 0) {
        return passed(bench.label(device, "onControllerLoss", says) +
                      (time > 0 ? " after " + toText(time) + " s" : ""));
    }
    const std::string& type = bench.plant().deviceType().name;
    return failed(
        "onControllerLoss is 0 (Unknown); try what it does when nobody controls it any "
        "more, and write that into its type, or into one of your own that extends it where " +
        type + " is a shipped one: <type name=\"My" + type + "\" extends=\"" + type +
        "\" …><data name=\"onControllerLoss\" default=\"2\"/> (2 StopsOnRamp; 'cortex "
        "types " +
        type + "' lists all)");
}

Judgement observationsGood(Bench& bench, std::size_t) {
    const Plant& plant = bench.plant();
    if (plant.observations.empty()) return skipped("it has no observations");
    const auto worst = [&](const Sample& sample) -> const std::uint32_t* {
        const auto isBad = [&](std::uint32_t each) {
            return sample.slot(each).quality != Quality::Good;
        };
        const auto found = std::ranges::find_if(plant.observations, isBad);
        return found == plant.observations.end() ? nullptr : &*found;
    };
    const auto areGood = [&](const Sample& sample) { return worst(sample) == nullptr; };
    if (bench.recording().becomes(areGood, goodTime))
        return passed(plural(plant.observations.size(), "observation"));
    const std::uint32_t* bad = worst(bench.now());
    if (bad == nullptr) return passed();
    const std::string& path = plant.path(*bad);
    return failed(path + " is " + name(bench.now().slot(*bad).quality) + ", and was not good for " +
                  toText(goodTime) + " s; is the device switched on and connected? 'cortex show " +
                  path + "' says because of what, 'cortex events " + plant.path(plant.device) +
                  "' since when");
}

// Of a drive of CiA 402 the processor gives torque, and its own startup waits for the link alone.
bool mayMoveAtStartup(const Plant& plant) {
    return !plant.demands.empty() && !plant.deviceIs("Ds402Device");
}

Judgement states(Bench& bench, std::size_t) {
    const std::uint32_t device = bench.plant().device;
    const std::string& path = bench.plant().path(device);
    if (mayMoveAtStartup(bench.plant()) && !bench.wishes().move)
        return skipped("its startup may move it or give it power; --move AMPLITUDE allows that");
    if (bench.now().stateOf(device) == State::Active) {
        return skipped("it is Active, and somebody may need it; shut it down first: cortex call " +
                       path + " shutdown");
    }
    const double begin = bench.now().seconds();
    bench.bring(device, State::Active);
    const double active = bench.now().seconds();
    bench.bring(device, State::Standby);
    const double standby = bench.now().seconds();
    return passed("Active after " + numberText(active - begin, 3) + " s, in Standby again after " +
                  numberText(standby - active, 3) + " s");
}

// Nothing can bring any device into a fault from here. One that is cleared cannot be put back.
Judgement faultClears(Bench& bench, std::size_t) {
    const std::uint32_t device = bench.plant().device;
    const std::string& path = bench.plant().path(device);
    if (bench.now().stateOf(device) != State::Fault) {
        return skipped(
            "it is not in Fault; bring it into one by hand (pull its plug), and run this "
            "again while it is");
    }
    const std::string fault = bench.faultText(device);
    const comms::CommandAnswer answer = bench.call(device, "clearFaults");
    const auto isOut = [&](const Sample& each) { return each.stateOf(device) == State::Standby; };
    if (answer.done() && bench.recording().becomes(isOut, goodTime))
        return passed("it was in Fault" + fault + " and is now in Standby");
    return failed("clearFaults left it in " + stateText(bench.now(), device) + fault + ": " +
                  answer.text() + "; is the cause gone? 'cortex events " + path + "' says more");
}

Judgement ofHonesty(const std::string& wrong, const Honesty& honesty) {
    if (!wrong.empty()) return failed(wrong);
    return passed("in " + plural(honesty.cycles(), "cycle"));
}

Judgement stampsHonest(Bench& bench, std::size_t) {
    if (bench.plant().observations.empty()) return skipped("it has no observations");
    bench.recording().pass(lookTime);
    const Honesty honesty = bench.recording().honesty();
    return ofHonesty(honesty.stamps(), honesty);
}

Judgement ageHonest(Bench& bench, std::size_t) {
    const Honesty honesty = bench.recording().honesty();
    return ofHonesty(honesty.age(), honesty);
}

Judgement countersMonotonic(Bench& bench, std::size_t) {
    const Honesty honesty = bench.recording().honesty();
    return ofHonesty(honesty.counters(), honesty);
}

}  // namespace

Tests deviceTests() {
    const std::vector<std::string> device{"Device"};
    return {{"types and rules are complete", device, {}, {}, typesAndRules},
            {"loss of its controller is stated", device, {}, {}, controllerLoss},
            {"observations are good", device, {}, {}, observationsGood},
            {"a fault clears", device, {}, {}, faultClears},
            {"states are reached", device, {}, {}, states}};
}

Tests honestyTests() {
    return {{"stamps are honest", {"Device"}, {}, {}, stampsHonest},
            {"age is honest", {"FieldbusDevice"}, {}, {}, ageHonest},
            {"counters never fall", {"FieldbusDevice"}, {}, {}, countersMonotonic}};
}

}  // namespace cortex::cli::conform
