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
// A writer is not quicker than 100 numbers in a millisecond.
constexpr std::int64_t mostAtOnce = 4096, nsEach = 10'000;
constexpr std::int64_t second = 1'000'000'000, measuring = 50'000'000, ahead = 100'000'000;  // ns

}  // namespace

bool WriterNumbers::admits(const WriterGuid& writer, std::int64_t number, std::uint32_t saying,
                           std::int64_t now) {
    if (number > greatest) return false;
    auto* const known = writers_.find(writer);
    if (known == nullptr) {
        writers_.placeFor(writer) = {writer, now, {.newest = number, .since = now}};
        return true;
    }
    Numbers& numbers = known->value;
    const std::int64_t newest = numbers.newest;
    if (number <= newest) {
        // A writer that is far below again and again was forged before it was met.
        numbers.below = number < newest - farBelow ? numbers.below + 1 : 0;
        if (numbers.below >= timesBelow) numbers = {.newest = number, .since = now};
        if (number < newest) count(numbers, now);
        return true;
    }
    if (number > newest + mostAtOnce + (now - known->met) / nsEach) return false;
    const std::int64_t candidate = numbers.candidate;
    const bool goesOn =
        candidate != 0 && number != candidate && std::abs(number - candidate) <= window(numbers);
    const bool isSaidAgain = number == candidate && saying != numbers.saying;
    if (number > newest + window(numbers) && !goesOn && !isSaidAgain) {
        numbers.candidate = number;
        numbers.saying = saying;
        return false;
    }
    numbers.newest = number;
    numbers.candidate = 0;
    numbers.below = 0;
    known->met = now;
    count(numbers, now);
    return true;
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
