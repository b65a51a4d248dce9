// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// What agents keep of the past, with what came of it live.
namespace cortex::common {

using AgentEvents = std::vector<comms::AgentEvent>;

void sortByTime(AgentEvents& events);  // by the clock of each agent

// Each once, in order of time: of what came both ways that which came live, as it says more. What
// was never published, such as a value that changed, has no number and is kept alone.
AgentEvents merged(AgentEvents kept, AgentEvents live);

// Whether it is at or below a path, or tells who has control of something at, below or above it:
// the path of such an event is that of the agent.
bool concerns(const comms::AgentEvent& event, const std::string& prefix);

// "commands are kept since 2026-11-29T10:12:07.250Z; older ones are not kept"; "" where everything
// after `from` is kept, UTC ns. `epoch`: of the agent, UTC microseconds. `timeText`: of UTC ns, as
// the times of the events are shown; with milliseconds.
std::string keptText(std::vector<comms::PastEvents::Since> since, std::int64_t from,
                     std::int64_t epoch, const std::function<std::string(std::int64_t)>& timeText);

// The newest fault at or below a path, and those at most a second before it: the first of them
// comes nearest to the cause. Places in events in order of time.
struct FaultChain {
    std::size_t first = 0, newest = 0;
    std::size_t faults = 0;  // at or below the path
};
inline constexpr std::uint32_t chainTime = 1'000'000'000;  // ns
std::optional<FaultChain> newestFaults(const AgentEvents& byTime, const std::string& prefix);

std::int64_t timeBefore(std::int64_t time, std::int64_t nanoseconds);  // or the first there is
// What was not longer before this one, itself last.
AgentEvents beforeEvent(const AgentEvents& byTime, std::size_t place, std::int64_t nanoseconds);
// "-2.310 s": when it was, seen from the later one.
std::string secondsBefore(const comms::AgentEvent& event, const comms::AgentEvent& later);

}  // namespace cortex::common
