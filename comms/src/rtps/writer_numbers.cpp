// SPDX-License-Identifier: Apache-2.0
#include "rtps/writer_numbers.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace cortex::comms::rtps {
namespace {

constexpr std::int64_t smallStep = 4;
constexpr std::int64_t longestCount = 1 << 24;  // numbers that Fast DDS counts in some 50 ms
constexpr std::int64_t greatest = 1LL << 40;    // 34 years of 1 kHz
constexpr std::int64_t farBelow = 4096;
constexpr int timesBelow = 32;
// What needs no run: 100 numbers in a millisecond.
constexpr std::int64_t mostAtOnce = 4096, nsEach = 10'000;
constexpr std::int64_t second = 1'000'000'000, measuring = 50'000'000, ahead = 100'000'000;  // ns

constexpr std::int64_t skippedFor = 3 * second;  // ns

constexpr int runLength = 8;
constexpr std::int64_t steady = 30'000'000, longestPause = 50'000'000;  // ns
constexpr std::int64_t nsEachInRun = 2'500;  // between two of its numbers
constexpr std::int64_t nearInRun = 64;       // where 95 % are lost
constexpr std::int64_t nsEachAtLeast = 100;  // no writer is quicker
// Fast DDS counts so many in some 3 s. A longer jump needs a longer run, so that counting takes a
// third of the time at most, whatever is forged.
constexpr std::int64_t longJump = 1LL << 30, nsEachBeyond = 10;

}  // namespace

bool WriterNumbers::admits(const WriterGuid& writer, std::int64_t number, std::uint32_t saying,
                           std::int64_t now) {
    auto* const known = writers_.find(writer);
    if (known == nullptr) {
        if (number > greatest) return false;
        writers_.placeFor(writer) = {writer, now, {.newest = number, .since = now}};
        return true;
    }
    Numbers& numbers = known->value;
    const std::int64_t newest = numbers.newest;
    if (number <= newest) {
        // A writer that is far below again and again was forged before it was met.
        numbers.below = number < newest - farBelow ? numbers.below + 1 : 0;
        if (numbers.below >= timesBelow)
            numbers = {.newest = number,
                       .since = now,
                       .reached = numbers.reached,
                       .belowSince = numbers.belowSince,
                       .lastBelow = numbers.lastBelow};
        if (number < newest) count(numbers, now);
        return pass(numbers, number, now);
    }
    const std::int64_t pause = now - known->met;
    const std::int64_t atOnce = std::min(window(numbers), mostAtOnce + pause / nsEach);
    const bool passes = number <= newest + atOnce ||
                        (number <= greatest &&
                         goesOn(numbers, {.last = number, .met = now, .saying = saying}, pause));
    if (!passes) return false;
    numbers.newest = number;
    numbers.runs = {};
    numbers.below = 0;
    known->met = now;
    count(numbers, now);
    return pass(numbers, number, now);
}

// What passes is known to the reader, whatever is forgotten here.
bool WriterNumbers::pass(Numbers& numbers, std::int64_t number, std::int64_t now) {
    if (number >= numbers.reached) {
        if (number > numbers.reached) numbers.belowSince = 0;
        numbers.reached = number;
        return true;
    }
    if (numbers.belowSince == 0) numbers.belowSince = now;
    numbers.lastBelow = now;
    return true;
}

bool WriterNumbers::areSkipped(const WriterGuid& writer, std::int64_t now) const {
    const auto* const known = writers_.find(writer);
    if (known == nullptr || known->value.belowSince == 0) return false;
    const Numbers& numbers = known->value;
    return numbers.lastBelow - numbers.belowSince >= skippedFor && now - numbers.lastBelow < second;
}

// Whether a number that is too high passes, as others came near it.
bool WriterNumbers::goesOn(Numbers& numbers, Run next, std::int64_t pause) {
    Run& run = runBefore(numbers, next);
    const bool isFirst = run.length == 0;
    const std::int64_t step = next.last - run.last;
    if (!isFirst && step == 0 && next.saying == run.saying) return false;  // a datagram twice
    next.begun = isFirst ? next.met : run.begun;
    next.length = std::min(run.length + 1, runLength);
    run = next;
    if (isFirst) return false;
    const std::int64_t jump = next.last - numbers.newest;
    if (std::abs(step) <= window(numbers) && jump <= mostAtOnce + pause / nsEach) return true;
    const std::int64_t lasted = next.met - next.begun;
    return run.length == runLength && step <= nearInRun + window(numbers) &&
           jump <= mostAtOnce + pause / nsEachAtLeast &&
           lasted >= steady + std::max<std::int64_t>(jump - longJump, 0) * nsEachBeyond;
}

// The run that this number continues, the nearer one. If there is none, a new one in the place of
// that which has waited longest.
WriterNumbers::Run& WriterNumbers::runBefore(Numbers& numbers, const Run& next) {
    const auto distance = [&](const Run& run) {
        return run.length > 0 ? std::abs(next.last - run.last) : greatest;
    };
    Run& nearest = *std::ranges::min_element(numbers.runs, {}, distance);
    const std::int64_t silent = std::min(next.met - nearest.met, longestPause);
    if (distance(nearest) <= mostAtOnce + window(numbers) + silent / nsEachInRun) return nearest;
    Run& oldest = *std::ranges::min_element(numbers.runs, {}, [](const Run& run) {
        return std::pair{run.met, run.length};  // all of a datagram has one time
    });
    oldest = {};
    return oldest;
}

void WriterNumbers::count(Numbers& numbers, std::int64_t now) {
    ++numbers.arrived;
    const std::int64_t time = now - numbers.since;
    if (time < measuring) return;
    numbers.perSecond = std::clamp(std::exchange(numbers.arrived, 0) * second / time,
                                   numbers.perSecond / 2, second / nsEach);
    numbers.since = now;
}

std::int64_t WriterNumbers::window(const Numbers& numbers) {
    return smallStep + numbers.perSecond * ahead / second;
}

std::int64_t WriterNumbers::stepTo(const WriterGuid& writer, std::int64_t first) {
    auto* const known = writers_.find(writer);
    if (known == nullptr) return first;
    std::int64_t& before = known->value.first;
    const std::int64_t step = std::min(first, before + longestCount);
    before = std::max(before, step);
    return step;
}

}  // namespace cortex::comms::rtps
