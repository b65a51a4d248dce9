// SPDX-License-Identifier: Apache-2.0
#include "in_turn.hpp"

#include <algorithm>

namespace cortex::profiler {
namespace {

constexpr double partSeconds = 1e-3;  // short enough that some are left alone by all else

double nanoseconds(const Contender& contender, std::int64_t cycles) {
    return static_cast<double>(contender.run(cycles).count());
}

double oneRound(const Contender& contender, std::int64_t cycles, const Rounds& rounds) {
    const double parts = std::max(1.0, rounds.seconds / partSeconds);
    const auto fit = static_cast<std::int64_t>(static_cast<double>(cycles) / parts);
    const std::int64_t part = std::max<std::int64_t>(1, fit);
    double best = nanoseconds(contender, part);
    for (std::int64_t i = 2 * part; i <= cycles; i += part) {
        best = std::min(best, nanoseconds(contender, part));
    }
    return best / static_cast<double>(part);
}

}  // namespace

double Contender::best() const { return rounds.empty() ? 0 : *std::ranges::min_element(rounds); }

void measureInTurn(std::vector<Contender>& contenders, const Rounds& rounds) {
    std::vector<std::int64_t> cycles;
    for (const Contender& each : contenders) {
        each.run(10);
        const double one = nanoseconds(each, 10) / 10;
        const auto fit = static_cast<std::int64_t>(rounds.seconds * 1e9 / std::max(one, 1.0));
        cycles.push_back(std::clamp<std::int64_t>(fit, 3, 1'000'000));
    }
    for (int round = 0; round < rounds.count; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            contenders[i].run(2);  // what the others drove out of the caches
            contenders[i].rounds.push_back(oneRound(contenders[i], cycles[i], rounds));
        }
    }
}

}  // namespace cortex::profiler
