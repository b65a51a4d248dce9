// SPDX-License-Identifier: Apache-2.0
#include "window/stop_order.hpp"

#include "cortex/core/path.hpp"

#include "session/lease.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <algorithm>
#include <chrono>

namespace cortex::explorer {

namespace {

constexpr int patience = 10'000;     // ms, with agents that do not answer
constexpr int betweenTries = 100;    // ms
constexpr int lastValues = 1000;     // ms after the last answer, until states are told too
constexpr int mostNotFollowing = 3;  // that are named
constexpr std::chrono::milliseconds stopLimit = std::chrono::seconds{70};  // it may take a minute

QString say(const char* text) { return QCoreApplication::translate("StopOrder", text); }

bool isStoppable(const SimplexInfo& info, const std::string& prefix) {
    const Type& type = *info.layout->type;
    return !info.remote && type.active() && !type.isA("Agent") && isAtOrBelow(info.path, prefix);
}

// Whether the agent itself has said what became of it.
bool isAnswer(const CommandOutcome& outcome) {
    const CallResult& answer = outcome.answer;
    return outcome.problem.empty() && answer.outcome != Outcome::Unknown &&
           answer.outcome != Outcome::Expired && answer.reason != Reason::Restarted;
}

}  // namespace

void StopOrder::begin(const std::string& prefix, const QString& scope) {
    prefix_ = prefix;
    scope_ = scope;
    told_.clear();
    paths_.clear();
    refusals_.clear();
    ended_.clear();
    since_.start();
    answered_.start();
    const auto frame = session_.frame();
    for (const AgentFrame& agent : frame->agents) {
        if (agent.structure && !hasBelow(agent, prefix_)) continue;
        told_.push_back({agent.status.name});
        send(told_.back());
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            if (isStoppable(info, prefix_)) paths_.push_back(info.path);
        }
    }
    active_ = !told_.empty();
    text_ = say("Nobody is heard: nothing was stopped.");
    if (active_) count(*frame);
}

void StopOrder::send(Told& told) {
    told.number = session_.send("/" + told.agent, "shutdown", {{"prefix", prefix_}}, stopLimit);
    told.sent.start();
}

void StopOrder::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    if (!active_) {
        if (!agrees(frame)) text_.clear();
        return;
    }
    for (const CommandOutcome& each : outcomes) take(each);
    const bool goesOn = !since_.hasExpired(patience);
    for (Told& each : told_) {
        if (goesOn && !each.answered && each.number == 0 && each.sent.hasExpired(betweenTries)) {
            send(each);
        }
    }
    const bool waits = std::ranges::any_of(
        told_, [&](const Told& each) { return !each.answered && (goesOn || each.number != 0); });
    if (waits) answered_.restart();
    const bool follows = std::ranges::all_of(paths_, [&](const std::string& path) {
        return !wasReached(frame, path) || stateOf(frame, path) == cortex::State::Standby;
    });
    if (!waits && (follows || answered_.hasExpired(lastValues)))
        finish(frame);
    else
        count(frame);
}

void StopOrder::take(const CommandOutcome& outcome) {
    const auto told = std::ranges::find(told_, outcome.number, &Told::number);
    if (outcome.number == 0 || told == told_.end()) return;
    told->number = 0;
    told->answered = isAnswer(outcome);
    if (!told->answered || outcome.answer.done()) return;
    refusals_ << say("%1: %2").arg(QString::fromStdString(told->agent),
                                   QString::fromStdString(outcome.answer.text()));
}

// While it is on its way.
void StopOrder::count(const Frame& frame) {
    const auto standing = std::ranges::count_if(paths_, [&](const std::string& path) {
        return stateOf(frame, path) == cortex::State::Standby;
    });
    text_ = say("Stopping %1: %2 of %3 in Standby").arg(scope_).arg(standing).arg(paths_.size());
    const QStringList lost = unanswered(frame, true);
    if (!lost.isEmpty()) text_ += say("; not heard: %1").arg(lost.join(", "));
}

// What followed, what did not and why, and when that was.
void StopOrder::finish(const Frame& frame) {
    active_ = false;
    for (const std::string& each : paths_) ended_[each] = stateOf(frame, each);
    const QString others = notFollowed(frame);
    const QStringList unreached = unanswered(frame, false);
    QStringList parts;
    if (!unreached.isEmpty()) parts << say("Not reached: %1").arg(unreached.join(", "));
    if (!others.isEmpty()) parts << others;
    parts << refusals_;
    const double seconds = static_cast<double>(since_.elapsed()) / 1000;
    text_ = parts.isEmpty()
                ? say("All %1 in Standby, %2 s").arg(paths_.size()).arg(seconds, 0, 'f', 1)
                : parts.join(QStringLiteral("; "));
    text_ += ", " + QDateTime::currentDateTimeUtc().toString(QStringLiteral("HH:mm:ss"));
}

QString StopOrder::notFollowed(const Frame& frame) const {
    QStringList named;
    int all = 0;
    for (const std::string& path : paths_) {
        const State state = stateOf(frame, path);
        if (!wasReached(frame, path) || state == cortex::State::Standby) continue;
        if (++all > mostNotFollowing) continue;
        named << say("%1 (%2)").arg(
            QString::fromStdString(path),
            state ? QString{QLatin1String{name(*state)}} : say("not heard"));
    }
    if (all > mostNotFollowing) named << QStringLiteral("…");
    return all == 0 ? QString{} : say("%1 did not follow: %2").arg(all).arg(named.join(", "));
}

QStringList StopOrder::unanswered(const Frame& frame, bool lostOnly) const {
    QStringList names;
    for (const Told& each : told_) {
        const auto agent = std::ranges::find(frame.agents, each.agent,
                                             [](const AgentFrame& one) { return one.status.name; });
        const bool lost = agent == frame.agents.end() || agent->lost();
        if (!each.answered && (lost || !lostOnly)) names << QString::fromStdString(each.agent);
    }
    return names;
}

StopOrder::State StopOrder::stateOf(const Frame& frame, const std::string& path) const {
    const auto place = frame.find(path);
    if (!place || frame.agents[place->agent].lost()) return std::nullopt;
    return frame.agents[place->agent].state(place->simplex);
}

bool StopOrder::wasReached(const Frame& frame, const std::string& path) const {
    const auto place = frame.find(path);
    return !place || std::ranges::any_of(told_, [&](const Told& each) {
        return each.answered && each.agent == frame.agents[place->agent].status.name;
    });
}

bool StopOrder::agrees(const Frame& frame) const {
    return std::ranges::all_of(ended_, [&](const auto& each) {
        const State now = stateOf(frame, each.first);
        return each.second ? !now || now == each.second : now != cortex::State::Standby;
    });
}

}  // namespace cortex::explorer
