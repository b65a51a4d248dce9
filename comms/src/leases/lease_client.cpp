// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/lease_client.hpp"

#include "cortex/core/path.hpp"
#include "cortex/core/service_threads.hpp"

#include "leases/control_asks.hpp"
#include "leases/errand.hpp"
#include "leases/kept_leases.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace cortex::comms {
namespace {

using Milliseconds = std::chrono::milliseconds;
using Moment = Errand::Moment;
using Names = std::vector<std::string>;

constexpr Milliseconds whileWaiting{5}, atRest{100};  // between two looks at answers
constexpr Milliseconds betweenOffers{500}, betweenAsks{100};
constexpr Milliseconds patience{3000};  // with an agent that does not answer
constexpr Milliseconds releaseLimit{1000};

constexpr const char* commands[] = {"takeControl", "releaseControl", "handOverControl"};

}  // namespace

struct LeaseClient::Implementation {
    enum class Verb { Take, Release, HandOver };  // as `commands`
    // What was asked for with one call, of several agents.
    struct Operation {
        Verb verb = Verb::Take;
        std::vector<Errand> errands;
    };

    explicit Implementation(Mirror& own) : mirror{own}, kept{own}, asks{own} {}

    std::uint64_t begin(Verb verb, const std::string& prefix, const Names& agents);
    std::uint64_t beginHandOver(const std::vector<Lease>& leases, const std::string& to);
    Names holding(const std::string& prefix, const Names& agents) const;
    bool advance(Operation& operation, Moment now);  // true: all have answered
    void finish(const Operation& operation);
    void finishTaking(const Operation& operation);
    void giveBack(const std::string& agent, const std::string& prefix);
    void lookAround(Moment now);
    void step(Moment now);
    void run();
    void releaseAll();

    Mirror& mirror;
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::uint64_t last = 0;
    std::map<std::uint64_t, Operation> operations;
    std::map<std::uint64_t, Answers> results;
    std::vector<Errand> releases;  // of what was granted in vain
    KeptLeases kept;
    ControlAsks asks;
    std::vector<std::string> askNews;
    std::function<void()> look;
    Moment looked{}, heard{};
    bool renews = true, stopping = false;
    std::thread thread;
};

std::uint64_t LeaseClient::Implementation::begin(Verb verb, const std::string& prefix,
                                                 const Names& agents) {
    Operation operation{verb, {}};
    for (const std::string& agent : agents) {
        operation.errands.push_back({agent, prefix});
        operation.errands.back().send(mirror, commands[static_cast<int>(verb)],
                                      {{"prefix", prefix}}, patience);
    }
    operations.emplace(++last, std::move(operation));
    changed.notify_all();
    return last;
}

std::uint64_t LeaseClient::Implementation::beginHandOver(const std::vector<Lease>& leases,
                                                         const std::string& to) {
    Operation operation{Verb::HandOver, {}};
    for (const Lease& each : leases) {
        operation.errands.push_back({each.agent, each.prefix});
        operation.errands.back().send(mirror, "handOverControl",
                                      {{"prefix", each.prefix}, {"to", Names{to}}}, patience);
    }
    operations.emplace(++last, std::move(operation));
    changed.notify_all();
    return last;
}

Names LeaseClient::Implementation::holding(const std::string& prefix, const Names& agents) const {
    Names found;
    for (const Lease& each : kept.held()) {
        const bool meant = agents.empty() || std::ranges::find(agents, each.agent) != agents.end();
        if (meant && each.prefix == prefix) found.push_back(each.agent);
    }
    return found;
}

// What one agent has granted is renewed while another one is still asked.
bool LeaseClient::Implementation::advance(Operation& operation, Moment now) {
    bool over = true;
    for (Errand& each : operation.errands) {
        if (each.over()) continue;
        const bool answered = each.poll(mirror, now, patience);
        over = over && answered;
        if (answered && operation.verb == Verb::Take && each.answer.done()) {
            kept.grant(each.agent, each.prefix, each.sent);
        }
    }
    return over;
}

void LeaseClient::Implementation::finish(const Operation& operation) {
    if (operation.verb == Verb::Take) return finishTaking(operation);
    if (operation.verb == Verb::Release) return;
    for (const Errand& each : operation.errands) {
        if (each.answer.done()) kept.dropBelow(each.agent, each.prefix);
    }
}

// Where no answer came, it may have been taken all the same, and nobody would renew it.
void LeaseClient::Implementation::finishTaking(const Operation& operation) {
    const bool taken = std::ranges::all_of(operation.errands,
                                           [](const Errand& each) { return each.answer.done(); });
    for (const Errand& each : operation.errands) {
        if (taken) {
            kept.settle(each.agent, each.prefix);
        } else if (each.answer.done() || each.answer.outcome == Outcome::Unknown) {
            kept.drop(each.agent, each.prefix);
            giveBack(each.agent, each.prefix);
        }
    }
}

void LeaseClient::Implementation::giveBack(const std::string& agent, const std::string& prefix) {
    releases.push_back({agent, prefix});
    releases.back().send(mirror, "releaseControl", {{"prefix", prefix}}, releaseLimit);
}

void LeaseClient::Implementation::step(Moment now) {
    for (auto each = operations.begin(); each != operations.end();) {
        if (!advance(each->second, now)) {
            ++each;
            continue;
        }
        finish(each->second);
        Answers& answers = results[each->first];
        for (Errand& errand : each->second.errands) {
            answers.push_back({errand.agent, std::move(errand.answer)});
        }
        each = operations.erase(each);
        changed.notify_all();
    }
    std::erase_if(releases, [&](Errand& each) { return each.poll(mirror, now, releaseLimit); });
    lookAround(now);
    kept.renew(now, renews);
}

void LeaseClient::Implementation::lookAround(Moment now) {
    // What is being taken, or was just released, may still stand in an image.
    if (look && operations.empty() && releases.empty() && now - looked >= betweenOffers) {
        looked = now;
        look();
        kept.findOffers();
    }
    if (now - heard < betweenAsks) return;
    heard = now;
    asks.step(now, askNews);
}

void LeaseClient::Implementation::run() {
    std::unique_lock lock{mutex};
    while (!stopping) {
        step(std::chrono::steady_clock::now());
        const bool waits = !operations.empty() || !releases.empty() || kept.waits();
        changed.wait_for(lock, waits ? whileWaiting : atRest);
    }
}

void LeaseClient::Implementation::releaseAll() {
    for (const auto& [number, operation] : operations) {
        for (const Errand& each : operation.errands) {
            if (operation.verb == Verb::Take) giveBack(each.agent, each.prefix);
        }
    }
    for (const Lease& each : kept.granted()) giveBack(each.agent, each.prefix);
    asks.withdraw();
    const Moment end = std::chrono::steady_clock::now() + releaseLimit;
    for (Errand& each : releases) {
        const auto left =
            std::chrono::duration_cast<Milliseconds>(end - std::chrono::steady_clock::now());
        if (each.over()) continue;
        mirror.waitForAnswer(each.number, each.answer, std::max(left, Milliseconds{0}));
    }
}

LeaseClient::LeaseClient(Mirror& mirror)
    : implementation_{std::make_unique<Implementation>(mirror)} {
    const ServiceThreads named{"cortex-leases"};
    implementation_->thread = std::thread{[this] { implementation_->run(); }};
}

LeaseClient::~LeaseClient() {
    {
        const std::lock_guard lock{implementation_->mutex};
        implementation_->stopping = true;
    }
    implementation_->changed.notify_all();
    implementation_->thread.join();
    implementation_->releaseAll();
}

std::uint64_t LeaseClient::take(const std::string& prefix, const std::vector<std::string>& agents) {
    const std::lock_guard lock{implementation_->mutex};
    return implementation_->begin(Implementation::Verb::Take, prefix, agents);
}

std::uint64_t LeaseClient::release(const std::string& prefix,
                                   const std::vector<std::string>& agents) {
    Implementation& self = *implementation_;
    const std::lock_guard lock{self.mutex};
    const std::vector<std::string> from = self.holding(prefix, agents);
    for (const std::string& agent : from) self.kept.drop(agent, prefix);
    return self.begin(Implementation::Verb::Release, prefix, from);
}

std::uint64_t LeaseClient::handOver(const std::string& prefix, const std::string& to,
                                    const std::vector<std::string>& agents) {
    const std::lock_guard lock{implementation_->mutex};
    std::vector<Lease> leases;
    for (const std::string& each : implementation_->holding(prefix, agents)) {
        leases.push_back({each, prefix});
    }
    return implementation_->beginHandOver(leases, to);
}

// Of several that lie below one another the widest takes the others with it.
std::uint64_t LeaseClient::grant(const Asked& asked) {
    const std::lock_guard lock{implementation_->mutex};
    std::vector<Lease> leases = asked.gives;
    std::erase_if(leases, [&](const Lease& each) {
        return std::ranges::any_of(asked.gives, [&](const Lease& other) {
            return other.agent == each.agent && other.prefix != each.prefix &&
                   isAtOrBelow(each.prefix, other.prefix);
        });
    });
    return implementation_->beginHandOver(leases, asked.tool);
}

void LeaseClient::refuse(const Asked& asked) {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->asks.refuse(asked);
}

std::vector<LeaseClient::Asked> LeaseClient::asked() const {
    const std::lock_guard lock{implementation_->mutex};
    return implementation_->asks.asked(implementation_->kept.held());
}

std::vector<LeaseClient::Holder> LeaseClient::holdersOf(const std::string& prefix) const {
    return comms::holdersOf(implementation_->mirror, prefix);
}

void LeaseClient::ask(const std::string& prefix) {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->asks.ask(prefix, std::chrono::steady_clock::now());
}

void LeaseClient::withdraw() {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->asks.withdraw();
}

LeaseClient::Asking LeaseClient::asking() const {
    const std::lock_guard lock{implementation_->mutex};
    return implementation_->asks.asking();
}

bool LeaseClient::poll(std::uint64_t number, Answers& answers) {
    const std::lock_guard lock{implementation_->mutex};
    auto result = implementation_->results.extract(number);
    if (result.empty()) return false;
    answers = std::move(result.mapped());
    return true;
}

LeaseClient::Answers LeaseClient::wait(std::uint64_t number) {
    Implementation& self = *implementation_;
    std::unique_lock lock{self.mutex};
    self.changed.wait(
        lock, [&] { return self.results.contains(number) || !self.operations.contains(number); });
    auto result = self.results.extract(number);
    return result.empty() ? Answers{} : std::move(result.mapped());
}

std::vector<LeaseClient::Lease> LeaseClient::held() const {
    const std::lock_guard lock{implementation_->mutex};
    return implementation_->kept.held();
}

bool LeaseClient::covers(std::string_view agent, std::string_view path) const {
    return std::ranges::any_of(held(), [&](const Lease& each) {
        return each.agent == agent && isAtOrBelow(path, each.prefix);
    });
}

void LeaseClient::acceptOffers(std::function<void()> look) {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->look = std::move(look);
}

void LeaseClient::renew(bool renews) {
    const std::lock_guard lock{implementation_->mutex};
    implementation_->renews = renews;
}

std::vector<std::string> LeaseClient::news() {
    const std::lock_guard lock{implementation_->mutex};
    std::vector<std::string> news = implementation_->kept.takeNews();
    for (std::string& each : std::exchange(implementation_->askNews, {})) {
        news.push_back(std::move(each));
    }
    return news;
}

}  // namespace cortex::comms
