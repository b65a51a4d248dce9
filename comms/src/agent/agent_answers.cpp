// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_answers.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostWays = 256;
constexpr std::int64_t longestUnused = 60 * nsPerSecond;

}  // namespace

bool AgentAnswers::send(const Answer& answer, std::int64_t now) {
    auto way = ways_.find(answer.sender);
    if (way == ways_.end()) {
        if (!makeRoom(now)) return false;
        auto writer = participant_.writer<Answer>(topics::answerTo(answer.sender));
        way = ways_.emplace(answer.sender, Way{std::move(writer)}).first;
    }
    way->second.used = now;
    way->second.writer->write(answer);
    return true;
}

// A participant that invents senders gets at most that many endpoints a nsPerSecond.
bool AgentAnswers::makeRoom(std::int64_t now) {
    if (ways_.size() < mostWays) return true;
    const auto oldest =
        std::ranges::min_element(ways_, {}, [](const auto& each) { return each.second.used; });
    if (now - oldest->second.used < nsPerSecond) return false;
    ways_.erase(oldest);
    return true;
}

void AgentAnswers::keep(const std::function<bool(const std::string&)>& isKnown, std::int64_t now) {
    for (auto& [sender, way] : ways_) {
        if (isKnown(sender)) way.used = now;
    }
    std::erase_if(ways_, [&](const auto& each) { return now - each.second.used > longestUnused; });
}

}  // namespace cortex::comms
