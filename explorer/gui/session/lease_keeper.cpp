// SPDX-License-Identifier: Apache-2.0
#include "session/lease_keeper.hpp"

#include "cortex/core/error.hpp"

#include "session/lease.hpp"

#include <algorithm>
#include <utility>

namespace cortex::explorer {

namespace {

using namespace std::chrono_literals;

constexpr auto betweenRenewals = 500ms;
constexpr auto budgetOfOne = std::chrono::milliseconds{1000};
constexpr auto patience = 3s;  // with an agent that does not answer
constexpr auto lifetime = 2s;  // of a lease without a renewal, as the agent counts it

std::int64_t wallClock() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace

LeaseKeeper::LeaseKeeper(comms::Mirror& mirror) : mirror_{mirror} { control_.self = mirror.name(); }

LeaseKeeper::~LeaseKeeper() {
    release();
    const Moment end = std::chrono::steady_clock::now() + budgetOfOne;
    for (const Kept& each : kept_) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            end - std::chrono::steady_clock::now());
        comms::CommandAnswer answer;
        if (each.number != 0) mirror_.waitForAnswer(each.number, answer, std::max(left, 0ms));
    }
}

void LeaseKeeper::send(Kept& kept, const char* command) {
    if (kept.number != 0) mirror_.abandon(kept.number);
    kept.number = 0;
    kept.sent = std::chrono::steady_clock::now();
    try {
        kept.number =
            mirror_.send("/" + kept.agent, command, {{"prefix", kept.prefix}}, budgetOfOne);
    } catch (const Error& error) {  // the agent is gone, has no control, or the prefix is too long
        kept.refusal = error.what();
    }
}

void LeaseKeeper::take(const std::string& prefix, const Frame& frame) {
    if (!asked_.empty()) return;
    asked_ = prefix;
    control_.asks = prefix;
    for (const AgentFrame& agent : frame.agents) {
        if (agent.lost() || !hasBelow(agent, prefix)) continue;
        const bool ours = std::ranges::any_of(kept_, [&](const Kept& each) {
            return each.agent == agent.status.name && each.prefix == prefix &&
                   each.phase == Phase::Held;
        });
        if (ours) continue;
        kept_.push_back({agent.status.name, prefix, Phase::Asked, 0, {}, {}, {}, false});
        send(kept_.back(), "takeControl");
    }
}

void LeaseKeeper::release() {
    for (Kept& each : kept_) {
        if (each.phase == Phase::Released) continue;
        each.phase = Phase::Released;
        send(each, "releaseControl");
    }
    asked_.clear();
    control_.asks.clear();
    control_.prefix.clear();
    control_.agents.clear();
}

void LeaseKeeper::step(const Frame& frame, bool renews) {
    const Moment now = std::chrono::steady_clock::now();
    for (Kept& each : kept_) settle(each, now);
    if (!asked_.empty()) finishTaking(frame);
    for (Kept& each : kept_) {
        if (renews && each.phase == Phase::Held) renew(each, now);
        const bool late = now - each.renewed > lifetime;
        if (each.phase == Phase::Held && (late || !each.refusal.empty())) {
            tell("Control of " + each.prefix + " of " + each.agent + " was lost: " +
                 (each.refusal.empty() ? "it was not renewed for 2 s." : each.refusal + "."));
            each.phase = Phase::Released;
            std::erase(control_.agents, each.agent);
            if (control_.agents.empty()) control_.prefix.clear();
        }
    }
    std::erase_if(
        kept_, [](const Kept& each) { return each.phase == Phase::Released && each.number == 0; });
}

void LeaseKeeper::settle(Kept& kept, Moment now) {
    if (kept.number == 0) return;
    comms::CommandAnswer answer;
    if (mirror_.poll(kept.number, answer)) {
        kept.number = 0;
        if (kept.phase == Phase::Released) return;
        if (answer.done()) {
            kept.phase = Phase::Held;
            kept.renewed = kept.sent;  // the agent's two seconds began later
        } else if (kept.phase == Phase::Asked || answer.outcome == Outcome::Rejected) {
            kept.refusal = answer.text();
            kept.rejected = answer.outcome == Outcome::Rejected;
        }
    } else if (kept.phase != Phase::Held && now - kept.sent > patience) {
        mirror_.abandon(std::exchange(kept.number, 0));
        kept.refusal = "no answer for 3 s";
    }
}

// All have answered: it is ours, or all that was got is released again.
void LeaseKeeper::finishTaking(const Frame& frame) {
    std::string refusals;
    bool waits = false;
    std::vector<std::string> agents;
    for (const Kept& each : kept_) {
        if (each.prefix != asked_ || each.phase == Phase::Released) continue;
        if (!each.refusal.empty()) {
            const auto agent = std::ranges::find(frame.agents, each.agent,
                                                 [](const auto& one) { return one.status.name; });
            const auto other = agent != frame.agents.end()
                                   ? leaseOfOthers(*agent, asked_, control_.self)
                                   : std::nullopt;
            refusals += " " + each.agent + ": " +
                        (other ? other->holder + " holds " + other->prefix +
                                     ", and must release it or hand it over."
                               : each.refusal + ".");
        } else if (each.phase == Phase::Asked) {
            waits = true;
        } else {
            agents.push_back(each.agent);
        }
    }
    if (waits) return;
    const std::string prefix = std::exchange(asked_, {});
    control_.asks.clear();
    const bool taken = refusals.empty() && !agents.empty();
    for (Kept& each : kept_) {
        if (each.phase == Phase::Released || (each.prefix == prefix) == taken) continue;
        if (!taken && each.prefix != prefix) continue;  // what was held before stays
        each.phase = Phase::Released;
        if (!each.rejected) send(each, "releaseControl");
    }
    if (taken) {
        control_.prefix = prefix;
        control_.agents = std::move(agents);
        control_.since = wallClock();
        control_.notice.clear();
    } else if (refusals.empty()) {
        tell("Nothing was taken: nobody who is heard has anything at or below " + prefix + ".");
    } else {
        tell("Control of " + prefix + " was not taken." + refusals);
    }
}

void LeaseKeeper::renew(Kept& kept, Moment now) {
    if (now - kept.sent < (kept.number == 0 ? betweenRenewals : budgetOfOne)) return;
    send(kept, "renewControl");
}

void LeaseKeeper::tell(std::string text) { control_.notice = std::move(text); }

}  // namespace cortex::explorer
