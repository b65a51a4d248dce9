// SPDX-License-Identifier: Apache-2.0
#include "live/leases.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/path.hpp"
#include "cortex/core/service_threads.hpp"

#include "live/lease_table.hpp"

#include <algorithm>

namespace cortex::explorer {
namespace {

using Milliseconds = std::chrono::milliseconds;

constexpr Milliseconds betweenRenewals{500};
constexpr Milliseconds renewalBudget{1000};
constexpr Milliseconds lifetime{2000};      // without a renewal, as the agent counts it
constexpr Milliseconds releaseLimit{1000};  // at the end, each

}  // namespace

Leases::Leases(comms::Mirror& mirror) : mirror_{mirror} {
    const ServiceThreads named{"cortex-leases"};
    thread_ = std::thread{[this] { keep(); }};
}

Leases::~Leases() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
    for (const Key& each : held()) release(each, releaseLimit);
}

comms::CommandAnswer Leases::ask(const Key& key, const char* command, const std::string& to,
                                 Milliseconds limit) {
    comms::Mirror::Arguments arguments{{"prefix", key.prefix}};
    if (!to.empty()) arguments["to"] = std::vector<std::string>{to};
    try {
        return mirror_.call("/" + key.agent, command, arguments, limit);
    } catch (const Error& error) {  // an agent without control, or a prefix that is too long
        comms::CommandAnswer answer;
        answer.outcome = Outcome::Rejected;
        answer.why = error.what();
        return answer;
    }
}

// Where no answer came, it may have been taken all the same: given back, as nobody will renew it.
comms::CommandAnswer Leases::take(const Key& key, Milliseconds limit) {
    set(key, State::Asked);
    comms::CommandAnswer answer = ask(key, "takeControl", "", limit);
    if (answer.done()) {
        set(key, State::Held);
    } else {
        forget(key);
        if (answer.outcome == Outcome::Unknown) ask(key, "releaseControl", "", releaseLimit);
    }
    return answer;
}

comms::CommandAnswer Leases::release(const Key& key, Milliseconds limit) {
    comms::CommandAnswer answer = ask(key, "releaseControl", "", limit);
    forget(key);
    return answer;
}

// What is held further down goes along.
comms::CommandAnswer Leases::handOver(const Key& key, const std::string& to, Milliseconds limit) {
    comms::CommandAnswer answer = ask(key, "handOverControl", to, limit);
    if (!answer.done()) return answer;
    const std::lock_guard lock{mutex_};
    std::erase_if(leases_, [&](const Lease& each) {
        return each.key.agent == key.agent && isAtOrBelow(each.key.prefix, key.prefix);
    });
    return answer;
}

std::vector<Leases::Key> Leases::held() const {
    const std::lock_guard lock{mutex_};
    std::vector<Key> keys;
    for (const Lease& each : leases_) {
        if (each.state == State::Held) keys.push_back(each.key);
    }
    return keys;
}

bool Leases::covers(const std::string& agent, const std::string& path) const {
    return std::ranges::any_of(held(), [&](const Key& each) {
        return each.agent == agent && isAtOrBelow(path, each.prefix);
    });
}

void Leases::acceptOffers(std::function<void()> look) {
    const std::lock_guard lock{mutex_};
    look_ = std::move(look);
}

std::vector<std::string> Leases::news() {
    const std::lock_guard lock{mutex_};
    return std::exchange(news_, {});
}

void Leases::set(const Key& key, State state) {
    const std::lock_guard lock{mutex_};
    auto found = std::ranges::find(leases_, key, &Lease::key);
    if (found == leases_.end()) found = leases_.insert(found, Lease{key, state, 0, {}, {}});
    found->state = state;
    found->renewed = std::chrono::steady_clock::now();
}

void Leases::forget(const Key& key) {
    const std::lock_guard lock{mutex_};
    std::erase_if(leases_, [&](const Lease& each) { return each.key == key; });
}

void Leases::keep() {
    std::unique_lock lock{mutex_};
    while (!stopping_) {
        if (look_) findOffers();
        const Moment now = std::chrono::steady_clock::now();
        std::erase_if(leases_,
                      [&](Lease& each) { return each.state != State::Asked && !renew(each, now); });
        changed_.wait_for(lock, betweenRenewals, [this] { return stopping_; });
    }
}

bool Leases::renew(Lease& lease, Moment now) {
    comms::CommandAnswer answer;
    const std::string control = "control of " + lease.key.prefix + " of agent " + lease.key.agent;
    if (lease.number != 0 && mirror_.poll(lease.number, answer)) {
        lease.number = 0;
        if (answer.done()) {
            lease.renewed = lease.sent;
            if (lease.state == State::Offered) news_.push_back(control + " is yours now");
            lease.state = State::Held;
        } else if (lease.state == State::Offered) {
            return false;  // it was ours, and the image is old
        } else if (answer.outcome == Outcome::Rejected) {
            news_.push_back(control + " was lost: the agent says that you do not hold it");
            return false;
        }
    }
    if (lease.state == State::Held && now - lease.renewed > lifetime) {
        news_.push_back(control + " was lost: the agent has confirmed no renewal for 2 s");
        return false;
    }
    if (lease.number == 0 || now - lease.sent > renewalBudget) send(lease, now);
    return lease.number != 0;
}

void Leases::send(Lease& lease, Moment now) {
    if (lease.number != 0) mirror_.abandon(lease.number);
    lease.sent = now;
    try {
        lease.number = mirror_.send("/" + lease.key.agent, "renewControl",
                                    {{"prefix", lease.key.prefix}}, renewalBudget);
    } catch (const Error&) {  // the agent is gone
        lease.number = 0;
        if (lease.state == State::Offered) return;
        news_.push_back("control of " + lease.key.prefix + " was lost: agent " + lease.key.agent +
                        " is gone");
    }
}

// Others may hand a lease over to us; it is ours once it is renewed.
void Leases::findOffers() {
    look_();
    for (const comms::AgentStatus& agent : mirror_.agents()) {
        for (const ShownLease& each : leasesOf(mirror_, agent)) {
            const Key key{agent.name, each.prefix};
            const bool known = std::ranges::find(leases_, key, &Lease::key) != leases_.end();
            if (each.holder != mirror_.name() || known) continue;
            leases_.push_back({key, State::Offered, 0, {}, std::chrono::steady_clock::now()});
        }
    }
}

}  // namespace cortex::explorer
