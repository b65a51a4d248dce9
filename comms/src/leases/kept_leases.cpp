// SPDX-License-Identifier: Apache-2.0
#include "leases/kept_leases.hpp"

#include "cortex/core/path.hpp"

#include "leases/lease_table.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

using Milliseconds = std::chrono::milliseconds;

constexpr Milliseconds betweenRenewals{500}, renewalBudget{1000};
constexpr Milliseconds lifetime{2000};  // without a renewal, as the agent counts it

std::int64_t wallClock() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::string controlOf(const LeaseClient::Lease& lease) {
    return "control of " + lease.prefix + " of agent " + lease.agent;
}

}  // namespace

KeptLeases::Kept* KeptLeases::find(std::string_view agent, std::string_view prefix) {
    const auto found = std::ranges::find_if(leases_, [&](const Kept& each) {
        return each.lease.agent == agent && each.lease.prefix == prefix;
    });
    return found != leases_.end() ? &*found : nullptr;
}

void KeptLeases::grant(const std::string& agent, const std::string& prefix, Moment sent) {
    if (Kept* const known = find(agent, prefix)) {  // taken again
        known->renewed = sent;
        return;
    }
    std::erase_if(lost_,
                  [&](const Lost& each) { return each.agent == agent && each.prefix == prefix; });
    leases_.push_back({{agent, prefix, wallClock()}, State::Granted, {agent}, sent});
}

void KeptLeases::settle(const std::string& agent, const std::string& prefix) {
    if (Kept* const kept = find(agent, prefix)) kept->state = State::Held;
}

void KeptLeases::drop(const std::string& agent, const std::string& prefix) {
    std::erase_if(leases_, [&](const Kept& each) {
        return each.lease.agent == agent && each.lease.prefix == prefix;
    });
}

void KeptLeases::dropBelow(const std::string& agent, const std::string& prefix) {
    std::erase_if(leases_, [&](const Kept& each) {
        return each.lease.agent == agent && isAtOrBelow(each.lease.prefix, prefix);
    });
}

void KeptLeases::findOffers() {
    for (const AgentStatus& agent : mirror_.agents()) {
        auto shown = shownLeases(agent, mirror_.image(agent.name));
        if (!shown) continue;
        std::erase_if(*shown, [&](const auto& each) { return each.holder != mirror_.name(); });
        std::erase_if(lost_, [&](const Lost& lost) {
            return lost.agent == agent.name &&
                   std::ranges::find(*shown, lost.prefix, &ShownLease::prefix) == shown->end();
        });
        for (const ShownLease& each : *shown) take(each);
    }
}

void KeptLeases::take(const ShownLease& shown) {
    if (Kept* const known = find(shown.agent, shown.prefix)) {
        known->cycle = shown.cycle;
    } else if (!wasLost(shown)) {
        leases_.push_back({{shown.agent, shown.prefix, wallClock()},
                           State::Offered,
                           {shown.agent},
                           std::chrono::steady_clock::now(),
                           shown.cycle});
    }
}

bool KeptLeases::wasLost(const ShownLease& shown) const {
    return std::ranges::any_of(lost_, [&](const Lost& each) {
        const bool same = each.cycle == 0 || each.cycle == shown.cycle;
        return each.agent == shown.agent && each.prefix == shown.prefix && same;
    });
}

void KeptLeases::renew(Moment now, bool renews) {
    std::erase_if(leases_, [&](Kept& each) { return !renewOne(each, now, renews); });
}

// An offer that is none was ours before, and the image that shows it is old.
bool KeptLeases::lose(const Kept& kept, const std::string& why) {
    if (kept.state != State::Offered) {
        lost_.push_back({kept.lease.agent, kept.lease.prefix, kept.cycle});
        news_.push_back(controlOf(kept.lease) + " was lost: " + why);
    }
    return false;
}

bool KeptLeases::hasEnded(const std::string& agent) const {
    return std::ranges::any_of(mirror_.agents(), [&](const AgentStatus& each) {
        return each.name == agent && each.ended;
    });
}

bool KeptLeases::renewOne(Kept& kept, Moment now, bool renews) {
    Errand& renewal = kept.renewal;
    if (!renewal.over() && renewal.poll(mirror_, now, renewalBudget)) {
        if (renewal.answer.outcome == Outcome::Rejected)
            return lose(kept, "the agent says that you do not hold it");
        if (renewal.answer.done()) {
            kept.renewed = renewal.sent;  // the agent's two seconds began later
            if (kept.state == State::Offered) {
                news_.push_back(controlOf(kept.lease) + " is yours now");
                kept.state = State::Held;
            }
        }
    }
    if (now - kept.renewed > lifetime)
        return lose(kept, hasEnded(kept.lease.agent)
                              ? "the agent has ended"
                              : "the agent has confirmed no renewal for 2 s");
    if (!renews || !renewal.over() || now - renewal.sent < betweenRenewals) return true;
    renewal.send(mirror_, "renewControl", {{"prefix", kept.lease.prefix}}, renewalBudget);
    return !renewal.over() || lose(kept, renewal.answer.why);
}

bool KeptLeases::waits() const {
    return std::ranges::any_of(leases_, [](const Kept& each) { return !each.renewal.over(); });
}

std::vector<KeptLeases::Lease> KeptLeases::held() const {
    std::vector<Lease> held;
    for (const Kept& each : leases_) {
        if (each.state == State::Held) held.push_back(each.lease);
    }
    return held;
}

std::vector<KeptLeases::Lease> KeptLeases::granted() const {
    std::vector<Lease> granted;
    for (const Kept& each : leases_) {
        if (each.state != State::Offered) granted.push_back(each.lease);
    }
    return granted;
}

std::vector<std::string> KeptLeases::takeNews() { return std::exchange(news_, {}); }

}  // namespace cortex::comms
