// SPDX-License-Identifier: Apache-2.0
#include "model/overview.hpp"

#include "cortex/core/event.hpp"
#include "cortex/core/path.hpp"

#include "model/agent_text.hpp"
#include "model/event_text.hpp"
#include "model/holders.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "model/value_text.hpp"
#include "session/lease.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::int64_t dayLong = 86'400'000'000'000;  // ns
constexpr std::int64_t oneAct = 5'000'000'000;        // ns, in which agents give what is asked for
constexpr std::size_t agentsNamed = 2;
constexpr int longestInNote = 30;  // letters, of a name

constexpr std::array lastKinds{EventKind::Command, EventKind::Refusal, EventKind::Control,
                               EventKind::Loss, EventKind::Fault};

QString onFirstPage(const char* text, int count = -1) {
    return QCoreApplication::translate("Overview", text, nullptr, count);
}

// That an input is back, which a system tells by the dozen. Of agents the window itself tells.
bool isReturn(const comms::AgentEvent& event) {
    return event.kind == name(EventKind::Loss) && event.severity == Severity::Info &&
           event.number != 0;
}

Shape shapeOfAgent(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    if (s.ended) return Shape::Ended;
    if (agent.lost()) return Shape::Lost;
    if (!s.standstill.empty() || s.overloaded) return Shape::Warning;
    return s.missing > 0 ? Shape::Incomplete : Shape::Agent;
}

QString stateOfAgent(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    if (s.ended) return onFirstPage("ended %1 ago").arg(wholeAgeText(s.age));
    if (agent.lost()) return onFirstPage("lost for %1").arg(wholeAgeText(s.age));
    return stateWord(s);
}

// What somebody took under one prefix in one act.
struct HeldPart {
    std::string prefix, holder;
    std::int64_t since = 0;  // of the first agent
    std::vector<std::string> agents{};
};

// When agents gave something is counted in their cycles, so it is the less exact the older it is.
bool isOneAct(const HeldPart& part, const HeldPart& later, std::int64_t now) {
    const std::int64_t inexact = std::max<std::int64_t>(now - part.since, 0) / 1000;
    return part.prefix == later.prefix && part.holder == later.holder &&
           later.since - part.since < oneAct + inexact;
}

// By prefix, holder and time.
std::vector<HeldPart> heldParts(const Frame& frame) {
    std::vector<HeldPart> all, parts;
    for (const AgentFrame& agent : frame.agents)
        for (const comms::ShownLease& each : leasesOf(agent))
            all.push_back({each.prefix, each.holder, each.since, {agent.status.name}});
    std::ranges::sort(all, {}, [](const HeldPart& each) {
        return std::tie(each.prefix, each.holder, each.since);
    });
    for (HeldPart& each : all) {
        const bool same = !parts.empty() && isOneAct(parts.back(), each, frame.utc);
        if (same)
            parts.back().agents.push_back(each.agents.front());
        else
            parts.push_back(std::move(each));
    }
    for (HeldPart& each : parts) std::ranges::sort(each.agents);
    return parts;
}

QString ofAgents(const std::vector<std::string>& names, std::size_t all) {
    if (names.size() == all && all > 1) return onFirstPage("all %1 agents").arg(all);
    if (names.size() > agentsNamed)
        return onFirstPage("%1 of %2 agents").arg(names.size()).arg(all);
    QStringList shown;
    for (const std::string& each : names) shown << plainText(each);
    return joined(shown);
}

QString sinceText(const Frame& frame, std::int64_t since) {
    const bool old = frame.utc - since > dayLong;
    return shownTimeText(since, old ? "yyyy-MM-dd HH:mm" : "HH:mm:ss");
}

}  // namespace

OverviewRows agentRows(const Frame& frame) {
    std::vector<const AgentFrame*> agents;
    for (const AgentFrame& each : frame.agents) agents.push_back(&each);
    std::ranges::sort(agents, {}, [](const AgentFrame* each) {
        return std::make_pair(troubleRank(*each), std::string_view{each->status.name});
    });
    OverviewRows rows;
    for (const AgentFrame* each : agents) {
        const std::string& name = each->status.name;
        const QStringList troubles = troublesOf(each->status);
        rows.push_back({name,
                        name,
                        shapeOfAgent(*each),
                        {plainText(name), stateOfAgent(*each),
                         each->lost() ? QStringLiteral("—") : rateText(each->status),
                         troubles.isEmpty() ? missedTicksText(*each) : troubles.front()}});
    }
    return rows;
}

QString agentIsGone(const Frame& frame, const std::string& name) {
    const auto gone = std::ranges::find(frame.gone, name, &GoneAgent::name);
    const bool ended = gone != frame.gone.end() && gone->ended;
    return ended ? onFirstPage("It ended at %1.").arg(timeAndZone(gone->when, "HH:mm:ss"))
                 : onFirstPage("It is not heard.");
}

OverviewRows controlRows(const Frame& frame) {
    OverviewRows rows;
    std::map<std::string, int> moments;  // of one part, by the key without them
    for (const HeldPart& part : heldParts(frame)) {
        std::string key = part.prefix + '\n' + part.holder;
        const int moment = moments[key]++;
        key += '\n' + std::to_string(moment);
        const bool ours = part.holder == frame.control.self;
        const QString who = ours ? onFirstPage("you: %1").arg(ownName(frame.control))
                                 : wholeNameOf(frame.control, part.holder);
        const QString scope = part.prefix == "/" ? scopeText(part.prefix) : plainText(part.prefix);
        rows.push_back({std::move(key),
                        part.prefix,
                        std::nullopt,
                        {scope, who, ofAgents(part.agents, frame.agents.size()),
                         sinceText(frame, part.since)}});
    }
    return rows;
}

QString controlIsGone(const Frame& frame) {
    return std::ranges::any_of(frame.agents, &AgentFrame::isSilent)
               ? onFirstPage("No agent that is heard says so now.")
               : onFirstPage("It is not held any more.");
}

QString controlNote(const Frame& frame, bool held, std::size_t named) {
    QStringList silent;
    for (const AgentFrame& each : frame.agents)
        if (each.isSilent()) silent << cutName(plainText(each.status.name), longestInNote);
    const auto first = static_cast<int>(std::max<std::size_t>(named, 1));
    if (silent.isEmpty()) return held ? onFirstPage("All else is held by nobody.") : QString{};
    QString names = joined(silent);
    if (silent.size() > first)
        names = onFirstPage("%1 and %2 more")
                    .arg(silent.mid(0, first).join(QStringLiteral(", ")),
                         QString::number(silent.size() - first));
    return onFirstPage("Not heard, so not known of: %1.").arg(names);
}

std::string lastKey(const comms::AgentEvent& event) {
    return event.agent + '\n' + std::to_string(event.epoch) + '\n' + std::to_string(event.number) +
           '\n' + std::to_string(event.wallClock);
}

std::optional<OverviewRow> lastRow(const EventRow& row) {
    const comms::AgentEvent& event = row.event;
    const bool wanted =
        std::ranges::any_of(lastKinds, [&](EventKind each) { return event.kind == name(each); });
    if (!wanted || row.isGap() || row.isRoutine() || isReturn(event)) return std::nullopt;
    const bool isShort = row.times == 1 && tellsOfCommand(event.kind);
    QString what = isShort ? plainText(personAlone(event.text)) : row.text();
    if (row.times > 1) what += QStringLiteral("  ×") + countText(row.times);
    const QString time = shownTimeText(event.wallClock, "HH:mm:ss");
    return OverviewRow{lastKey(event),
                       event.path,
                       row.isFault() ? Shape::Fault : shapeOf(event.severity),
                       {time, plainText(event.path), what},
                       {},
                       row.text(),
                       event.wallClock,
                       event.kind == name(EventKind::Loss)};
}

std::string simplexAt(const Frame& frame, const std::string& path) {
    if (frame.find(path)) return path;
    std::string first;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        for (const SimplexInfo& each : agent.structure->simplexes) {
            if (each.remote || !isAtOrBelow(each.path, path)) continue;
            if (first.empty() || each.path < first) first = each.path;
        }
    }
    return first;
}

}  // namespace cortex::gui
