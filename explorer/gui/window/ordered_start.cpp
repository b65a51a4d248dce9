// SPDX-License-Identifier: Apache-2.0
#include "window/ordered_start.hpp"

#include "cortex/core/path.hpp"

#include "model/item_of.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "session/utc_now.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace cortex::gui {

namespace {

constexpr std::chrono::milliseconds longestStart =
    std::chrono::seconds{70};            // it may take a minute
constexpr int lastStates = 1000;         // ms after an answer, until states are told too
constexpr std::ptrdiff_t mostNamed = 3;  // that did not start
constexpr int toBeRead = 10'000;         // ms, in which it can be read whatever happens

const AgentFrame* heardAgent(const Frame& frame, const std::string& name) {
    const auto found = std::ranges::find(frame.agents, name,
                                         [](const AgentFrame& each) { return each.status.name; });
    const bool known = found != frame.agents.end() && !found->lost() && found->structure;
    return known ? &*found : nullptr;
}

bool hasEnded(const Frame& frame, const std::string& agent) {
    const auto isIt = [&](const AgentFrame& each) { return each.status.name == agent; };
    const auto known = std::ranges::find_if(frame.agents, isIt);
    if (known != frame.agents.end()) return known->status.ended;
    return std::ranges::any_of(
        frame.gone, [&](const GoneAgent& each) { return each.name == agent && each.ended; });
}

// Who works and has it as an output may manage it. That is not told, but its agent knows it: a
// command of the agent for the path of this one leaves it to its manager.
bool mayBeManaged(const AgentFrame& agent, std::uint32_t simplex) {
    return std::ranges::any_of(agent.structure->edges, [&](const Edge& edge) {
        return edge.target == simplex && edge.rule->direction == Direction::Output &&
               edge.owner != noSimplex && agent.state(edge.owner) == State::Active;
    });
}

// Whether such a command would start nothing else.
bool standsAlone(const AgentFrame& agent, const std::string& path) {
    return std::ranges::none_of(agent.structure->simplexes, [&](const SimplexInfo& info) {
        const bool below = info.path != path && isAtOrBelow(info.path, path);
        return below && !info.remote && info.layout->type->active();
    });
}

QString reasonOf(const CommandOutcome& outcome) {
    const CallResult& answer = outcome.answer;
    if (!outcome.problem.empty()) return QString::fromStdString(outcome.problem);
    if (answer.outcome == Outcome::Unknown) return OrderedStart::tr("no answer came");
    if (answer.outcome == Outcome::Expired)
        return OrderedStart::tr("it reached its agent too late");
    return QString::fromStdString(answer.why.empty() ? answer.text() : answer.why);
}

}  // namespace

void OrderedStart::begin(const std::vector<SimplexOf>& all, const Frame& frame) {
    members_.clear();
    for (const SimplexOf& each : all) members_.push_back({each});
    order_ = startOrder(frame, all);
    begun_.start();
    active_ = true;
    refresh(frame, {});
}

void OrderedStart::forget() {
    active_ = false;
    text_.clear();
}

void OrderedStart::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    if (!active_) {
        if (!text_.isEmpty() && ended_.hasExpired(toBeRead) && !agrees(frame)) text_.clear();
        return;
    }
    for (const CommandOutcome& each : outcomes) take(each);
    for (Member& each : members_) look(frame, each);
    for (const std::size_t place : mayStart(order_, steps())) ask(frame, members_[place]);
    if (count(StartStep::Asked) == 0 && mayStart(order_, steps()).empty()) return finish();
    text_ = tr("Starting %1 again: %2 Active").arg(members_.size()).arg(count(StartStep::Active));
}

void OrderedStart::take(const CommandOutcome& outcome) {
    const auto member = std::ranges::find(members_, outcome.number, &Member::number);
    if (outcome.number == 0 || member == members_.end()) return;
    member->number = 0;
    member->since.start();
    if (!outcome.problem.empty() || !outcome.answer.done()) member->why = reasonOf(outcome);
}

void OrderedStart::look(const Frame& frame, Member& member) {
    const AgentFrame* agent = heardAgent(frame, member.simplex.agent);
    member.unheard = agent == nullptr;
    member.ended = member.unheard && hasEnded(frame, member.simplex.agent);
    if (member.unheard) return fail(member, tr("its agent was not heard"));
    const std::uint32_t simplex = agent->structure->find(member.simplex.path);
    if (simplex == noSimplex) return fail(member, tr("it is not there any more"));
    const auto state = agent->state(simplex);
    if (!state && begun_.hasExpired(lastStates)) fail(member, tr("its state has not come"));
    if (state == State::Active) member.step = StartStep::Active;
    if (state == State::StartingUp) {
        member.step = StartStep::Asked;
        member.since.start();
    }
    if (state == State::Standby) lookInStandby(member);
    if (state != State::Fault) return;
    const auto fault = itemOf<std::string>(*agent, simplex, "faultText");
    fail(member, fault && !fault->empty() ? tr("it is in Fault: %1").arg(plainText(*fault))
                                          : tr("it is in Fault"));
}

void OrderedStart::lookInStandby(Member& member) {
    if (member.step == StartStep::Active) return fail(member, tr("it was shut down"));
    const bool answered = member.step == StartStep::Asked && member.number == 0;
    if (!answered || !member.since.hasExpired(lastStates)) return;
    const bool left = member.ofAgent && member.why.isEmpty();
    if (member.why.isEmpty())
        member.why = left ? tr("it is left to what manages it") : tr("it is in Standby");
    member.step = left ? StartStep::Left : StartStep::Failed;
}

void OrderedStart::ask(const Frame& frame, Member& member) {
    const auto& [name, path] = member.simplex;
    const auto owner = frame.find(path);
    if (!owner) return;
    const AgentFrame& agent = frame.agents[owner->agent];
    if (agent.status.name != name)
        return fail(member, tr("%1 has this path").arg(QString::fromStdString(agent.status.name)));
    if (agent.state(owner->simplex) != State::Standby) return;
    member.ofAgent = mayBeManaged(agent, owner->simplex) && standsAlone(agent, path);
    if (member.ofAgent && !isTurnOf(member)) return;
    member.why.clear();
    member.step = StartStep::Asked;
    member.number = member.ofAgent
                        ? session_.send("/" + name, "startup", {{"prefix", path}}, longestStart)
                        : session_.send(path, "startup", {}, longestStart);
}

// An agent does one such command at a time, and a newer one ends it.
bool OrderedStart::isTurnOf(const Member& member) const {
    return std::ranges::none_of(members_, [&](const Member& other) {
        return other.ofAgent && other.number != 0 && other.simplex.agent == member.simplex.agent;
    });
}

void OrderedStart::fail(Member& member, const QString& why) {
    member.step = StartStep::Failed;
    member.why = why;
}

std::vector<StartStep> OrderedStart::steps() const {
    std::vector<StartStep> all;
    for (const Member& each : members_) all.push_back(each.step);
    return all;
}

std::ptrdiff_t OrderedStart::count(StartStep step) const {
    return std::ranges::count(members_, step, &Member::step);
}

void OrderedStart::finish() {
    active_ = false;
    ended_.start();
    const auto followed = count(StartStep::Active);
    const double seconds = static_cast<double>(begun_.elapsed()) / 1000;
    complete_ = followed == std::ssize(members_);
    QStringList parts{(complete_
                           ? tr("All %1 Active again, %2 s").arg(followed)
                           : tr("%1 of %2 Active again, %3 s").arg(followed).arg(members_.size()))
                          .arg(seconds, 0, 'f', 1)};
    text_ = (parts + failures()).join(QStringLiteral("; "));
    text_ += ", " + timeAndZone(utcNow(), "HH:mm:ss");
}

QStringList OrderedStart::failures() const {
    QStringList parts, unheard, ended;
    std::ptrdiff_t failed = 0;
    for (const Member& each : members_) {
        if (each.step != StartStep::Failed && each.step != StartStep::Left) continue;
        if (each.unheard)
            (each.ended ? ended : unheard) << QString::fromStdString(each.simplex.agent);
        else if (++failed <= mostNamed)
            parts << tr("%1 did not start: %2").arg(nameOf(each.simplex), each.why);
    }
    if (failed > mostNamed) parts << tr("%1 more did not start").arg(failed - mostNamed);
    const bool one = failed + unheard.size() + ended.size() == 1;
    unheard.removeDuplicates();
    ended.removeDuplicates();
    if (!ended.isEmpty()) parts << tr("ended: %1").arg(ended.join(", "));
    if (!unheard.isEmpty()) parts << tr("not heard: %1").arg(unheard.join(", "));
    if (const auto waits = count(StartStep::Waits); waits > 0)
        parts << (waits == 1 ? tr("%1 waits for %2") : tr("%1 wait for %2"))
                     .arg(waits)
                     .arg(one ? tr("it") : tr("them"));
    return parts;
}

QString OrderedStart::nameOf(const SimplexOf& simplex) const {
    const QString path = QString::fromStdString(simplex.path);
    const auto have = std::ranges::count_if(
        members_, [&](const Member& each) { return each.simplex.path == simplex.path; });
    return have < 2 ? path : tr("%1 of %2").arg(path, QString::fromStdString(simplex.agent));
}

// What was not done stays said until it is.
bool OrderedStart::agrees(const Frame& frame) const {
    const auto isActive = [&](const Member& each) -> std::optional<bool> {
        const AgentFrame* agent = heardAgent(frame, each.simplex.agent);
        if (agent == nullptr) return std::nullopt;
        return agent->state(agent->structure->find(each.simplex.path)) == State::Active;
    };
    if (complete_)
        return std::ranges::all_of(members_,
                                   [&](const Member& each) { return isActive(each) != false; });
    return std::ranges::any_of(members_,
                               [&](const Member& each) { return isActive(each) != true; });
}

}  // namespace cortex::gui
