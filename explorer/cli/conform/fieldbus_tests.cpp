// SPDX-License-Identifier: Apache-2.0
// What a device behind a bus or a socket has to do.
#include "conform/honesty.hpp"
#include "conform/motion.hpp"
#include "conform/tests.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::cli::conform {
namespace {

constexpr double openTime = 5;     // s, at least, for a link to open
constexpr double attended = 0.95;  // share of the exchanges that a thread begins at all
constexpr double rounding = 1e-9;
constexpr double goesOnTime = 1;  // s, at least, for the next exchange

struct Counts {
    double exchanges = 0, late = 0, errors = 0, reconnects = 0, seconds = 0, cycles = 0;
};

Counts countsOf(Bench& bench, const Sample& sample) {
    const auto at = [&](std::size_t i) {
        return sample.at(bench.plant().device, Honesty::counterNames[i]);
    };
    return {at(0), at(1), at(2), at(3), sample.seconds(), static_cast<double>(sample.cycle)};
}

std::string linkText(Bench& bench) {
    const std::uint32_t device = bench.plant().device;
    return bench.label(device, "link", bench.now().count(device, "link"));
}

// How long a device may take to open its link: it tries anew after this pause.
double timeToOpen(Bench& bench) {
    return std::max(openTime, 4 * bench.constant(bench.plant().device, "reconnectTime"));
}

void waitForLink(Bench& bench) {
    const std::uint32_t device = bench.plant().device;
    const auto isOpen = [&](const Sample& each) {
        return each.count(device, "link") == linkIsOpen;
    };
    if (bench.recording().becomes(isOpen, timeToOpen(bench))) return;
    const auto address = bench.value(device, "address");
    throw Ended{failed("the link is " + linkText(bench) + " and did not open within " +
                       toText(timeToOpen(bench)) + " s; does somebody answer at " +
                       (address ? toText(*address) : "its address") + "? 'cortex events " +
                       bench.plant().path(device) + "' says why")};
}

// A loop that may be late by so much sees as many exchanges more or fewer.
double slack(Bench& bench, double period) {
    const std::uint32_t cluster = bench.plant().cluster;
    const double late = cluster == noSimplex ? 0 : bench.now().at(cluster, "latenessMax") * 1e-6;
    return 2 + std::ceil(late / period);
}

// How often a device exchanges. It may keep to the cycles of its agent: a period between two of
// them is then a whole number of cycles, rounded as the device likes.
struct Periods {
    double shortest = 0, longest = 0;  // s
};

Periods periodsOf(Bench& bench) {
    const double cycle = bench.period() * bench.plant().info(bench.plant().device).every;
    const double wished = bench.constant(bench.plant().device, "exchangePeriod");
    if (wished <= 0) return {cycle, cycle};
    if (wished < cycle || cycle <= 0) return {wished, wished};
    return {std::min(wished, std::ceil(wished / cycle - 0.5) * cycle),
            std::ceil(wished / cycle - rounding) * cycle};
}

// One is exact: no more exchanges are answered than were due. A thread that wakes late leaves one
// out and has nothing to count, so fewer are wrong only where they are many without any excuse.
Judgement exchangesCounted(Bench& bench, std::size_t) {
    waitForLink(bench);
    const Periods periods = periodsOf(bench);
    if (!(periods.shortest > 0)) return skipped("its agent does not say how long its cycles are");
    const Counts begin = countsOf(bench, bench.now());
    bench.recording().pass(bench.wishes().seconds);
    const Counts end = countsOf(bench, bench.now());
    const double time = end.seconds - begin.seconds, answered = end.exchanges - begin.exchanges;
    const double most = std::floor(time / periods.shortest + slack(bench, periods.shortest));
    // What an agent did not run, its device had no reason to exchange.
    const double ran = std::min(time, (end.cycles - begin.cycles) * bench.period());
    const double least = attended * ran / periods.longest - slack(bench, periods.longest);
    const double late = end.late - begin.late, errors = end.errors - begin.errors;
    const bool isExcused = late + errors + end.reconnects - begin.reconnects > 0;
    const std::string seen = numberText(answered, 9) + " in " + numberText(time) + " s, " +
                             numberText(late, 9) + " of them late, " + numberText(errors, 9) +
                             " errors";
    if (answered > most) {
        return failed("exchangeCount grew by " + seen + ", and only " + numberText(most, 9) +
                      " were due in periods of " + numberText(periods.shortest) +
                      " s; does it count what was not answered, or twice?");
    }
    if (answered < least && !isExcused) {
        return failed("exchangeCount grew by " + seen + ", and about " +
                      numberText(std::ceil(ran / periods.longest), 9) +
                      " were due: those that are missing are counted neither as late nor as "
                      "errors; look at where it counts");
    }
    return passed(seen);
}

Judgement reconnects(Bench& bench, std::size_t) {
    const Plant& plant = bench.plant();
    for (const std::uint32_t each : {plant.device, plant.processor.value_or(plant.device)}) {
        if (bench.now().stateOf(each) != State::Active) continue;
        return skipped(plant.path(each) +
                       " is Active, and would lose its link; shut it down "
                       "first: cortex call " +
                       plant.path(each) + " shutdown");
    }
    waitForLink(bench);
    const Counts before = countsOf(bench, bench.now());
    const comms::CommandAnswer answer = bench.call(plant.device, "reconnect");
    if (!answer.done()) return failed("reconnect was not done: " + answer.text());
    const auto isBack = [&](const Sample& each) {
        return each.count(plant.device, "link") == linkIsOpen &&
               countsOf(bench, each).reconnects > before.reconnects;
    };
    const bool came = bench.recording().becomes(isBack, timeToOpen(bench));
    const Counts back = countsOf(bench, bench.now());
    const double more = back.reconnects - before.reconnects;
    if (!came || more != 1) {
        return failed("after reconnect() the link is " + linkText(bench) +
                      " and reconnectCount grew by " + numberText(more) +
                      "; expected were Open and 1 within " + toText(timeToOpen(bench)) + " s");
    }
    const auto goesOn = [&](const Sample& each) {
        return countsOf(bench, each).exchanges > back.exchanges;
    };
    const double soon = std::max(goesOnTime, 3 * bench.constant(plant.device, "exchangePeriod"));
    if (!bench.recording().becomes(goesOn, soon))
        return failed("the link is Open again, but exchangeCount stays at " +
                      numberText(back.exchanges));
    return passed("Open again after " + numberText(back.seconds - before.seconds) + " s");
}

}  // namespace

Tests fieldbusTests() {
    const std::vector<std::string> fieldbus{"FieldbusDevice"};
    return {{"exchanges are counted", fieldbus, {}, {}, exchangesCounted},
            {"reconnect() opens it again", fieldbus, {}, {}, reconnects}};
}

}  // namespace cortex::cli::conform
