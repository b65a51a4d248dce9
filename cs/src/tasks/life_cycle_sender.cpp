// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include "tasks/state_machine.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace cortex::cs {

// Handles on the three commands of a simplex of another agent.
struct SimplexCS::LifeCycleSender::Remote {
    CommandSender& of(LifeCycle command) {
        return senders[static_cast<std::size_t>(command) - std::size_t{1}];
    }
    std::array<CommandSender, 3> senders;  // in the order of LifeCycle, without None
    const CommandSender* last = nullptr;
};

SimplexCS::LifeCycleSender SimplexCS::lifeCycle(const RelatedSimplex& target, bool manage) {
    LifeCycleSender sender;
    sender.runtime_ = &runtime();
    if (target.isRemote() && target.type().isA("Active")) {
        if (manage) {
            throw Error(path() + ": " + target.path() +
                        " belongs to another agent, whose group commands do not ask this one: "
                        "leave out `manage`");
        }
        const InputSimplex input{target};
        sender.remote_ = std::make_shared<LifeCycleSender::Remote>();
        sender.remote_->senders = {input.command("startup", 1), input.command("shutdown", 1),
                                   input.command("clearFaults", 1)};
        sender.state_ = input.data<std::int64_t>("state");
        return sender;
    }
    const auto* active =
        target.isRemote() ? nullptr : dynamic_cast<const SimplexCS*>(&target.simplex());
    if (active == nullptr) {
        throw Error(path() + ": " + target.path() + " has no life cycle; it is a " +
                    target.type().name + ", not an active simplex");
    }
    sender.target_ = active->index();
    sender.isDelayed_ = target.isDelayed();
    sender.isManaged_ = manage;
    sender.state_ = InputSimplex{target}.data<std::int64_t>("state");
    if (manage) static_cast<SimplexCS&>(runtime().simplex(active->index())).manager_ = index();
    return sender;
}

AgentRuntime& SimplexCS::LifeCycleSender::bound() const {
    if (runtime_ == nullptr) throw UnboundHandle{"LifeCycleSender", this};
    return *runtime_;
}

State SimplexCS::LifeCycleSender::state() const {
    bound();
    return static_cast<State>(static_cast<std::int64_t>(state_));
}

const AnswerHead& SimplexCS::LifeCycleSender::answer() const {
    static const AnswerHead none;
    bound();
    return remote_ != nullptr && remote_->last != nullptr ? remote_->last->answer() : none;
}

void SimplexCS::LifeCycleSender::post(LifeCycle command) {
    AgentRuntime& agent = bound();
    if (remote_ == nullptr) return agent.postLifeCycle(target_, command, isDelayed_);
    CommandSender& sender = remote_->of(command);
    const bool runs = sender.answer().outcome == Outcome::Running;
    if (runs || sender.sent() != sender.answered()) return;
    sender.send();
    remote_->last = &sender;
}

namespace {

constexpr std::int64_t askAgainAfter = 500'000'000;  // ns

bool runs(State state) { return state == State::StartingUp || state == State::Active; }

}  // namespace

// At the begin of each exchange: what it has to know of the one that it looks at.
void SimplexCS::LifeCycleSender::look(const Tick& tick) {
    const AgentRuntime& agent = bound();
    if (!isManaged_) {
        const std::string who = remote_ != nullptr ? "a simplex of another agent"
                                                   : agent.structure().simplexes[target_].path;
        throw Error(who +
                    " is not managed by the simplex that hands it over: get the handle in "
                    "populate() by lifeCycle(target, true), of a simplex of this agent");
    }
    if (state() != State::Standby || !wanted_) askedAt_ = never;
    if (state() != State::Active)
        activeSince_ = never;
    else if (activeSince_ == never)
        activeSince_ = tick.cycle;
}

// Of one that is wanted: asks it to start where that is due. True: it has not followed.
bool SimplexCS::LifeCycleSender::refuses(const Tick& tick) {
    if (state() != State::Standby) return false;
    const bool asked = askedAt_ != never;
    const bool waited = asked && tick.nominalTime - askedAt_ >= askAgainAfter;
    // So many cycles until it has run and that can be seen.
    const std::int64_t heard =
        runtime_->structure().simplexes[target_].every + (isDelayed_ ? 1 : 0);
    const bool refused = asked && tick.cycle - askedIn_ >= heard;
    if (!asked || waited) {
        startup();
        askedAt_ = tick.nominalTime;
        askedIn_ = tick.cycle;
    }
    return refused;
}

// Whether both are Active, this one since later, and write a common simplex.
bool SimplexCS::LifeCycleSender::replaces(const LifeCycleSender& other) const {
    if (other.activeSince_ == never || activeSince_ <= other.activeSince_) return false;
    const Structure& structure = runtime_->structure();
    const SimplexInfo& own = structure.simplexes[target_];
    const auto edges = std::span{structure.edges}.subspan(own.firstEdge, own.edgeCount);
    return std::ranges::any_of(edges, [&](const Edge& edge) {
        const auto& writers = structure.simplexes[edge.target].writers;
        const bool writes = edge.rule->direction == Direction::Output;
        return writes && std::ranges::find(writers, other.target_) != writers.end();
    });
}

// `each` calls a function for each sender that takes part.
template <class Each>
SimplexCS::HandOver SimplexCS::LifeCycleSender::exchangeEach(const Each& each, const Tick& tick) {
    bool failed = false, othersActive = false, othersRest = true, allActive = true;
    each([&](LifeCycleSender& one) {
        one.look(tick);
        const State state = one.state();
        if (one.wanted_) {
            failed = failed || state == State::Fault;
            return;
        }
        othersActive = othersActive || state == State::Active;
        othersRest = othersRest && isResting(state);
        if (state == State::StartingUp) one.shutdown();
    });
    each([&](LifeCycleSender& one) {
        if (!one.wanted_) return;
        bool replaced = false;
        each([&](const LifeCycleSender& other) {
            replaced = replaced || (!other.wanted_ && other.replaces(one));
        });
        if (replaced) one.shutdown();
        allActive = allActive && !replaced && one.state() == State::Active;
        if (!failed) failed = one.refuses(tick);
    });
    each([&](LifeCycleSender& one) {
        const bool leaves = one.wanted_ ? failed && othersActive : allActive;
        if (leaves && runs(one.state())) one.shutdown();
    });
    if (failed) return HandOver::Failed;
    if (!allActive) return HandOver::Starting;
    return othersRest ? HandOver::Done : HandOver::Stopping;
}

SimplexCS::HandOver SimplexCS::LifeCycleSender::exchange(std::span<LifeCycleSender> all,
                                                         const Tick& tick) {
    return exchangeEach(
        [all](const auto& visit) {
            for (LifeCycleSender& one : all) visit(one);
        },
        tick);
}

SimplexCS::HandOver SimplexCS::LifeCycleSender::handOver(LifeCycleSender& to, const Tick& tick) {
    wanted_ = false;
    to.wanted_ = true;
    return exchangeEach(
        [this, &to](const auto& visit) {
            visit(*this);
            visit(to);
        },
        tick);
}

}  // namespace cortex::cs
