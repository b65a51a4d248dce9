// SPDX-License-Identifier: Apache-2.0
#include "window/order.hpp"

#include "cortex/core/path.hpp"

#include "model/holders.hpp"
#include "model/shown_time.hpp"
#include "session/lease.hpp"
#include "session/utc_now.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <chrono>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int patience = 10'000;      // ms, with agents that do not answer
constexpr int betweenTries = 100;     // ms
constexpr int turn = 500;             // ms, of one path where an agent has several
constexpr int lastValues = 1000;      // ms after the last answer, until states are told too
constexpr int untilRead = 10'000;     // ms, in which the result of a start can be read
constexpr int mostNotFollowing = 3;   // that are named
constexpr std::size_t mostPaths = 2;  // that are named
constexpr std::chrono::milliseconds limit = std::chrono::seconds{70};  // it may take a minute

struct Words {
    const char *command, *doing, *done, *nobody, *left;
    State goal;
};
constexpr Words words[] = {
    // in the order of Order::Kind
    {"shutdown", "Stopping %1: %2 of %3 in Standby", "%1 in Standby, %2 s",
     "Nobody is heard%1: nothing was stopped.", "not stopped, as not controlled: %1",
     State::Standby},
    {"startup", "Starting %1: %2 of %3 Active", "%1 Active, %2 s",
     "Nobody is heard%1: nothing was started.", "not started, as not controlled: %1",
     State::Active},
};

QString say(const char* text) { return QCoreApplication::translate("Order", text); }

bool isMeant(const SimplexInfo& info, const std::string& prefix) {
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

std::vector<std::string> widest(std::vector<std::string> prefixes) {
    const auto all = prefixes;
    std::erase_if(prefixes, [&](const std::string& each) {
        return std::ranges::any_of(all, [&](const std::string& other) {
            return other != each && isAtOrBelow(each, other);
        });
    });
    return prefixes;
}

std::vector<std::string> overlap(const std::vector<std::string>& prefixes,
                                 const std::vector<std::string>& others) {
    std::vector<std::string> parts;
    const auto add = [&](const std::string& path) {
        if (std::ranges::find(parts, path) == parts.end()) parts.push_back(path);
    };
    for (const std::string& each : prefixes) {
        for (const std::string& other : others) {
            if (isAtOrBelow(each, other))
                add(each);
            else if (isAtOrBelow(other, each))
                add(other);
        }
    }
    return widest(std::move(parts));
}

std::vector<std::string> permitted(const std::vector<std::string>& prefixes,
                                   const std::vector<std::string>& rights) {
    auto parts = overlap(prefixes, rights);
    return parts.empty() ? prefixes : parts;
}

QStringList leftOut(const Frame& frame, const std::vector<std::string>& prefixes) {
    QStringList names;
    for (const std::string& each : prefixes) {
        for (const QString& name : uncontrolled(frame, each)) {
            const auto parts = overlap({each}, frame.control.prefixesOf(name.toStdString()));
            names << (parts.empty() ? name : say("a part of %1").arg(name));
        }
    }
    names.removeDuplicates();
    return names;
}

int inStandby(const Frame& frame, const std::string& prefix) {
    int count = 0;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure || agent.lost()) continue;
        const auto& simplexes = agent.structure->simplexes;
        for (std::uint32_t i = 0; i < simplexes.size(); ++i)
            count += isMeant(simplexes[i], prefix) && agent.state(i) == State::Standby ? 1 : 0;
    }
    return count;
}

QString scopeWords(const std::vector<std::string>& prefixes) {
    QStringList all;
    for (const std::string& each : prefixes)
        all << (each == "/" ? say("all") : QString::fromStdString(each));
    return all.join(say(" and "));
}

QString scopeWord(const std::vector<std::string>& prefixes) {
    if (prefixes.size() <= mostPaths) return scopeWords(prefixes);
    return say("%1 and %2 more").arg(scopeWords({prefixes.front()})).arg(prefixes.size() - 1);
}

void Order::begin(std::vector<std::string> prefixes, Whom whom, const std::string& only) {
    const auto frame = session_.frame();
    const auto wanted = widest(std::move(prefixes));
    prefixes_ = permitted(wanted, frame->control.rights);
    narrowed_ = prefixes_ != wanted;
    only_ = only;
    told_.clear();
    meant_.clear();
    worked_.clear();
    refusals_.clear();
    over_.clear();
    left_ = whom == Whom::Held && only.empty() ? leftOut(*frame, prefixes_) : QStringList{};
    ended_.clear();
    since_.start();
    answered_.start();
    for (const AgentFrame& agent : frame->agents) {
        const std::string& name = agent.status.name;
        if (!only.empty() && name != only) continue;
        if (agent.status.ended) {
            if (hasMeant(agent, prefixes_)) over_ << QString::fromStdString(name);
            continue;
        }
        if (kind_ == Start && agent.isSilent()) continue;
        const auto parts =
            whom == Whom::All ? prefixes_ : overlap(prefixes_, frame->control.prefixesOf(name));
        for (const std::string& each : parts) tell(agent, each);
    }
    sendNext();
    active_ = !told_.empty();
    const bool ofAll = frame->agents.empty() || part().isEmpty();
    const QString of = ofAll ? QString{} : say(" that has anything of %1").arg(part());
    text_ = say(words[kind_].nobody).arg(of);
    if (active_) count(*frame);
}

bool Order::hasMeant(const AgentFrame& agent, const std::vector<std::string>& prefixes) {
    return agent.structure && std::ranges::any_of(prefixes, [&](const std::string& prefix) {
               return std::ranges::any_of(agent.structure->simplexes, [&](const SimplexInfo& info) {
                   return isMeant(info, prefix);
               });
           });
}

// That ended since it was told.
void Order::leaveEnded(const Frame& frame) {
    for (const AgentFrame& agent : frame.agents) {
        const std::string& name = agent.status.name;
        if (!agent.status.ended || std::ranges::count(told_, name, &Told::agent) == 0) continue;
        over_ << QString::fromStdString(name);
        std::erase_if(told_, [&](const Told& each) { return each.agent == name; });
        std::erase_if(meant_, [&](const Meant& each) { return each.agent == name; });
    }
}

void Order::tell(const AgentFrame& agent, const std::string& prefix) {
    if (agent.structure && !hasBelow(agent, prefix)) return;
    const std::size_t before = meant_.size();
    if (agent.structure) {
        const auto& simplexes = agent.structure->simplexes;
        for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
            if (!isMeant(simplexes[i], prefix)) continue;
            meant_.push_back({agent.status.name, simplexes[i].path});
            const auto state = agent.lastState(i);
            const bool works = state == cortex::State::Active || state == cortex::State::StartingUp;
            if (works) worked_.push_back(meant_.back());
        }
        // Where there is nothing to stop, another path is not interrupted for it.
        if (meant_.size() == before && prefixes_.size() > 1) return;
    }
    told_.push_back({agent.status.name, prefix});
}

QString Order::scope() const {
    const QString paths = scopeWord(prefixes_);
    return only_.empty() ? paths : say("%1 of agent %2").arg(paths, QString::fromStdString(only_));
}

// After "of"; empty: of everything.
QString Order::part() const {
    if (prefixes_.front() != "/") return scope();
    return only_.empty() ? QString{} : say("agent %1").arg(QString::fromStdString(only_));
}

void Order::forget() {
    active_ = false;
    ended_.clear();
    text_.clear();
}

bool Order::goesOn(const Told& told) const {
    const auto most = told.interrupted ? static_cast<int>(limit.count()) : patience;
    return kind_ == Stop && !told.answered && !since_.hasExpired(most);
}

// Of several paths of one agent, the one that waits longest, once the other has had its turn.
bool Order::mayBeSent(const Told& told) const {
    if (told.answered || told.number != 0) return false;
    const bool isFirst = !told.sent.isValid();
    if (!isFirst && (!goesOn(told) || !told.sent.hasExpired(betweenTries))) return false;
    return std::ranges::none_of(told_, [&](const Told& other) {
        if (&other == &told || other.agent != told.agent || other.answered) return false;
        if (other.number != 0) return !other.sent.hasExpired(turn);
        return !isFirst && (!other.sent.isValid() || other.sent.elapsed() > told.sent.elapsed());
    });
}

void Order::sendNext() {
    for (Told& each : told_) {
        if (mayBeSent(each)) send(each);
    }
}

void Order::send(Told& told) {
    told.number =
        session_.send("/" + told.agent, words[kind_].command, {{"prefix", told.prefix}}, limit);
    told.sent.start();
}

void Order::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    if (!active_) {
        if (!agrees(frame)) text_.clear();
        return;
    }
    for (const CommandOutcome& each : outcomes) take(each);
    leaveEnded(frame);
    sendNext();
    const bool waits = std::ranges::any_of(told_, [&](const Told& each) {
        return !each.answered && (goesOn(each) || each.number != 0);
    });
    if (waits) answered_.restart();
    const bool follows = std::ranges::all_of(meant_, [&](const Meant& each) {
        return !wasReached(each) || stateOf(frame, each) == words[kind_].goal;
    });
    if (!waits && (follows || answered_.hasExpired(lastValues)))
        finish(frame);
    else
        count(frame);
}

void Order::take(const CommandOutcome& outcome) {
    const auto told = std::ranges::find(told_, outcome.number, &Told::number);
    if (outcome.number == 0 || told == told_.end()) return;
    told->number = 0;
    const bool hasOthers = std::ranges::count(told_, told->agent, &Told::agent) > 1;
    told->interrupted = hasOthers && outcome.answer.outcome == Outcome::Cancelled;
    told->answered = isAnswer(outcome) && !told->interrupted;
    if (!told->answered || outcome.answer.done()) return;
    const QString refusal = say("%1: %2").arg(QString::fromStdString(told->agent),
                                              QString::fromStdString(outcome.answer.text()));
    if (!refusals_.contains(refusal)) refusals_ << refusal;
}

std::ptrdiff_t Order::followers(const Frame& frame) const {
    return std::ranges::count_if(
        meant_, [&](const Meant& each) { return stateOf(frame, each) == words[kind_].goal; });
}

// While it is on its way.
void Order::count(const Frame& frame) {
    const auto standing = followers(frame);
    text_ = say(words[kind_].doing).arg(scope()).arg(standing).arg(meant_.size());
    const QStringList silent = unanswered(frame, true);
    if (!silent.isEmpty()) text_ += say("; not heard: %1").arg(silent.join(", "));
    if (!over_.isEmpty()) text_ += say("; ended: %1").arg(over_.join(", "));
    if (!left_.isEmpty()) text_ += "; " + say(words[kind_].left).arg(left_.join(", "));
}

// What followed, what did not and why, and when that was. What a start leaves in Standby may be
// meant to stay there: agents say what they could not start.
void Order::finish(const Frame& frame) {
    active_ = false;
    for (const Meant& each : meant_) ended_[each] = stateOf(frame, each);
    const QString others = kind_ == Stop ? notFollowed(frame) : QString{};
    const QStringList unreached = unanswered(frame, false);
    QStringList parts;
    if (!unreached.isEmpty()) parts << say("Not reached: %1").arg(unreached.join(", "));
    if (!others.isEmpty()) parts << others;
    parts << refusals_;
    const double seconds = static_cast<double>(since_.elapsed()) / 1000;
    const auto followed = followers(frame);
    const bool all = parts.isEmpty() && followed == std::ssize(meant_);
    incomplete_ = kind_ == Stop ? !all : !parts.isEmpty();
    sinceEnd_.start();
    const QString of = part().isEmpty() ? QString{} : say(" of %1").arg(part());
    const char* const every = left_.isEmpty() ? "All %1" : "All %1 that you control";
    const QString count =
        all ? say(every).arg(followed) + of : say("%1 of %2").arg(followed).arg(meant_.size()) + of;
    parts.prepend(say(words[kind_].done).arg(count).arg(seconds, 0, 'f', 1));
    if (!over_.isEmpty()) parts << say("ended: %1").arg(over_.join(", "));
    if (!left_.isEmpty()) parts << say(words[kind_].left).arg(left_.join(", "));
    if (narrowed_) parts << say("you may command nothing else");
    text_ = parts.join(QStringLiteral("; "));
    text_ += ", " + timeAndZone(utcNow(), "HH:mm:ss");
}

QString Order::notFollowed(const Frame& frame) const {
    QStringList named;
    int all = 0;
    for (const Meant& each : meant_) {
        const State state = stateOf(frame, each);
        if (!wasReached(each) || state == words[kind_].goal) continue;
        if (++all > mostNotFollowing) continue;
        named << say("%1 (%2)").arg(
            nameOf(each), state ? QString{QLatin1String{name(*state)}} : say("not heard"));
    }
    if (all > mostNotFollowing) named << QStringLiteral("…");
    return all == 0 ? QString{} : say("%1 did not follow: %2").arg(all).arg(named.join(", "));
}

QStringList Order::unanswered(const Frame& frame, bool silentOnly) const {
    QStringList names;
    for (const Told& each : told_) {
        const auto agent = std::ranges::find(frame.agents, each.agent,
                                             [](const AgentFrame& one) { return one.status.name; });
        const bool silent = agent == frame.agents.end() || agent->isSilent();
        if (!each.answered && (silent || !silentOnly)) names << QString::fromStdString(each.agent);
    }
    names.removeDuplicates();
    return names;
}

QString Order::nameOf(const Meant& meant) const {
    QString path = QString::fromStdString(meant.path);
    if (std::ranges::count(meant_, meant.path, &Meant::path) < 2) return path;
    return say("%1 of %2").arg(path, QString::fromStdString(meant.agent));
}

Order::State Order::stateOf(const Frame& frame, const Meant& meant) const {
    const auto agent = std::ranges::find(frame.agents, meant.agent,
                                         [](const AgentFrame& each) { return each.status.name; });
    if (agent == frame.agents.end() || !agent->structure) return std::nullopt;
    return agent->state(agent->structure->find(meant.path));
}

bool Order::wasReached(const Meant& meant) const {
    return std::ranges::any_of(told_, [&](const Told& each) {
        return each.answered && each.agent == meant.agent && isAtOrBelow(meant.path, each.prefix);
    });
}

// What was not done stays said until it is, whatever else happens: a person closes it.
bool Order::agrees(const Frame& frame) const {
    if (kind_ == Start && sinceEnd_.isValid() && !sinceEnd_.hasExpired(untilRead)) return true;
    if (incomplete_) return followers(frame) < std::ssize(meant_);
    return std::ranges::all_of(ended_, [&](const auto& each) {
        const State now = stateOf(frame, each.first);
        return each.second ? !now || now == each.second : now != words[kind_].goal;
    });
}

}  // namespace cortex::gui
