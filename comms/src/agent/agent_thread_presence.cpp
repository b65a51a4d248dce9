// SPDX-License-Identifier: Apache-2.0
// What the thread of an agent says of the agent, again and again and at the end.
#include "cortex/core/clock.hpp"
#include "cortex/core/loop_pace.hpp"
#include "cortex/core/standstill.hpp"

#include "agent/agent_thread.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <thread>

namespace cortex::comms {
namespace {

constexpr std::int64_t silentInterval = 1'000'000'000;  // ns
constexpr std::size_t longestReason = 200;              // of a refusal, in a presence
constexpr int timesLastBlock = 5, timesStopping = 3;
constexpr std::chrono::milliseconds pauseStopping{10};

}  // namespace

Presence AgentThread::presence(const char* state) const {
    Presence presence = model_.presence(state, peers_.agents() + 1, lastEvent_);
    presence.interval = intervalAmong(presenceOut_->readers());
    presence.extras.insert(presence.extras.begin(),
                           {uptimeOfAgent, std::to_string(monotonicNow() - self_.began)});
    presence.extras.push_back({rootPaths, rivals_.roots()});
    presence.extras.push_back({summaries, "1"});
    presence.extras.push_back({ofThePast, "1"});
    if (const std::string pairs = textOf(rivals_.says()); !pairs.empty()) {
        presence.extras.push_back({firstOfPairs, pairs});
    }
    if (const std::string other = peers_.otherSelf(monotonicNow()); !other.empty()) {
        presence.extras.push_back({otherSelf, other});
    }
    if (self_.access.realTime) addTimes(presence);
    addRefusals(presence);
    return presence;
}

// The rest of what was rejected() are datagrams.
void AgentThread::addRefusals(Presence& presence) const {
    const std::string datagrams = participant_.dropped();
    const std::uint64_t messages = self_.rejections.count() + participant_.malformed();
    if (!datagrams.empty()) presence.extras.push_back({droppedDatagrams, datagrams});
    if (messages == 0) return;
    const std::string last = self_.rejections.last().substr(0, longestReason);
    presence.extras.push_back(
        {refusedMessages, std::to_string(messages) + (last.empty() ? "" : ": " + last)});
}

// A loop that is stepped by hand has no time of its own.
void AgentThread::addTimes(Presence& presence) const {
    const std::int64_t now = monotonicNow();
    presence.extras.push_back({clockOfAgent, std::to_string(now)});
    presence.extras.push_back({ageOfLoop, std::to_string(now - newCycleAt_)});
    if (const LoopPace* pace = self_.access.pace; pace != nullptr && pace->rate() > 0) {
        presence.extras.push_back({rateOfLoop, std::to_string(std::llround(pace->rate() * 1000))});
        if (pace->overloaded()) presence.extras.push_back({overloaded, "1"});
    }
    const StandstillNote* note = self_.access.standstill;
    const auto found = note != nullptr ? note->get() : std::nullopt;
    if (!found) return;
    presence.extras.push_back({standstill, found->why});
    presence.extras.push_back({timeStood, std::to_string(now - found->since)});
}

void AgentThread::sendPresence(std::int64_t now) {
    if (now < presenceDue_) return;
    const Presence said = presence(silent_ ? "silent" : "running");
    presenceOut_->write(said);
    if (silent_)
        presenceDue_ = now + silentInterval;
    else
        presenceDue_ = std::max(presenceDue_ + said.interval, now + said.interval / 2);
}

// While another start of the name was there first, nothing is said but that. What others know of
// this start they keep.
void AgentThread::beSilent(bool silent) {
    silent_ = silent;
    presenceDue_ = 0;
    if (!silent) sendInterest();
}

// Leaves the network after the last cycle. A silent agent disposes of nothing, because the keys
// belong to the other start. The last presence is sent more than once: the end of the writer
// travels through another socket. Under load it overtakes the last sample, which best-effort
// readers do not get again. The last block has the values after the shutdown, which are safe. So it
// comes before that, and more often: what loses one in five lost all of them in one of 15,000
// stops.
void AgentThread::leave() {
    step();
    if (silent_) return;
    for (int said = 0; said < timesLastBlock && streams_.repeatLinks(); ++said) {
        std::this_thread::sleep_for(pauseStopping);
    }
    while (!events_.empty()) sendEvents();
    const Presence last = presence("stopping");
    for (int said = 1; said < timesStopping; ++said) {
        presenceOut_->write(last);
        std::this_thread::sleep_for(pauseStopping);
    }
    presenceOut_->write(last);
    presenceOut_->dispose(last);
}

}  // namespace cortex::comms
