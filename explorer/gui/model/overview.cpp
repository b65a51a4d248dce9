// SPDX-License-Identifier: Apache-2.0
#include "model/overview.hpp"

#include "cortex/core/event.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/path.hpp"

#include "model/agent_text.hpp"
#include "model/event_text.hpp"
#include "model/fault_text.hpp"
#include "model/gone_text.hpp"
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
constexpr std::size_t agentsNamed = 2;

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

// "position 2.1 rad, above 2.0944": of an array the first element that is.
QString outsideItem(const DataItem& item, const Value& value, std::optional<Shape>& shape) {
    const std::size_t length = std::visit([](const auto& each) { return each.size(); }, value);
    const auto least = numberOf(item.min), most = numberOf(item.max);
    shape = Shape::NoLabel;
    std::size_t element = 0;
    for (; element + 1 < length; ++element) {
        const auto number = numberOf(value, element);
        if (number && ((least && *number < *least) || (most && *number > *most))) break;
    }
    const auto number = numberOf(value, element);
    QString name = QString::fromStdString(item.name);
    if (item.length > 1) name += QStringLiteral("[%1]").arg(element);
    const QString unit = item.unit.empty() ? QString{} : ' ' + unitText(item.unit);
    const QString shown = name + ' ' + elementText(item, value, element) + unit;
    if (number && most && *number > *most) {
        shape = Shape::AboveLimit;
        return onFirstPage("%1, above %2").arg(shown, numberText(item, *most));
    }
    if (number && least && *number < *least) {
        shape = Shape::BelowLimit;
        return onFirstPage("%1, below %2").arg(shown, numberText(item, *least));
    }
    return shown;  // "7 (no label)"
}

// The first item whose value is outside, and how many more there are.
void tellOutside(const AgentFrame& agent, std::uint32_t simplex, OverviewRow& row) {
    QString text;
    int more = 0;
    for (const ItemLayout& each : agent.structure->simplexes[simplex].layout->items) {
        const auto value = agent.value(simplex, each);
        if (!value || outsideText(*each.item, *value).empty()) continue;
        if (!row.item.empty() && ++more > 0) continue;
        row.item = each.item->name;
        text = outsideItem(*each.item, *value, row.shape);
    }
    row.cells << (more == 0 ? text : onFirstPage("%1; and %2 more").arg(text).arg(more));
}

QString faultWords(const Frame& frame, Place place, const StateTimes& times) {
    const QString code = faultCode(frame.agents[place.agent], place.simplex);
    const QString text = faultText(frame, place, times).text;
    const QString head = onFirstPage("Fault%1").arg(code);
    return text.isEmpty() ? head : onFirstPage("%1: %2").arg(head, text);
}

QString lossWords(const Frame& frame, Place place) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (agent.lost())
        return onFirstPage("Agent %1 is lost for %2, with all that it has")
            .arg(plainText(agent.status.name), wholeAgeText(agent.status.age));
    const QString gone = goneInputText(frame, place);
    if (!gone.isEmpty()) return gone;
    const auto age = agent.age(place.simplex);
    return age ? onFirstPage("Its values are lost for %1").arg(wholeAgeText(*age))
               : onFirstPage("Its values are lost");
}

// Frame and abnormal are of the same moment, unless somebody mixes them.
bool isThere(const Frame& frame, const Abnormal::Found& found) {
    if (found.place.agent >= frame.agents.size()) return false;
    const auto& structure = frame.agents[found.place.agent].structure;
    return structure && found.place.simplex < structure->simplexes.size() &&
           structure->simplexes[found.place.simplex].path == found.path;
}

OverviewRow wrongRow(const Frame& frame, Abnormal::Kind kind, const Abnormal::Found& found,
                     const StateTimes& times) {
    const AgentFrame& agent = frame.agents[found.place.agent];
    OverviewRow row{std::to_string(kind) + '\n' + agent.status.name + '\n' + found.path,
                    found.path,
                    kind == Abnormal::Fault ? Shape::Fault : Shape::Lost,
                    {plainText(found.path)}};
    if (kind == Abnormal::Fault) row.cells << faultWords(frame, found.place, times);
    if (kind == Abnormal::Outside) tellOutside(agent, found.place.simplex, row);
    if (kind == Abnormal::Lost) row.cells << lossWords(frame, found.place);
    if (frame.find(found.path) == found.place) return row;
    // Another agent has the path as well, and is what is opened.
    row.item.clear();
    row.cells.back() = onFirstPage("Of %1: %2").arg(plainText(agent.status.name), row.cells.back());
    return row;
}

// Paths that two agents have, both of which are heard.
std::vector<const comms::Contested*> doubled(const Frame& frame) {
    const auto isHeard = [&](const std::string& name) {
        return std::ranges::any_of(frame.agents, [&](const AgentFrame& agent) {
            return agent.status.name == name && !agent.lost();
        });
    };
    std::vector<const comms::Contested*> found;
    for (const comms::Contested& each : frame.contested)
        if (std::ranges::count_if(each.agents, isHeard) > 1) found.push_back(&each);
    return found;
}

// So many of them, and the row that says how many there are more.
template <class Found, class Row>
void addSome(OverviewRows& rows, const std::vector<Found>& all, const std::string& kind,
             const std::string& next, Row row) {
    for (std::size_t i = 0; i < std::min(all.size(), mostWrongOfAKind); ++i) row(all[i]);
    if (all.size() <= mostWrongOfAKind) return;
    const QString more = countText(all.size() - mostWrongOfAKind);
    rows.push_back(
        {kind + "\nmore",
         next,
         std::nullopt,
         {onFirstPage("and %1 more").arg(more), onFirstPage("F8 goes from one to the next")}});
}

// What somebody holds under one prefix.
struct HeldPart {
    std::vector<std::string> agents;
    std::int64_t since = 0;  // of the first of them
};

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

OverviewRows wrongRows(const Frame& frame, const Abnormal& abnormal, const StateTimes& times) {
    OverviewRows rows;
    for (const auto kind : {Abnormal::Fault, Abnormal::Outside, Abnormal::Lost}) {
        const auto& all = abnormal.found(kind);
        const bool many = all.size() > mostWrongOfAKind;
        addSome(rows, all, std::to_string(kind), many ? all[mostWrongOfAKind].path : "",
                [&](const Abnormal::Found& each) {
                    if (isThere(frame, each)) rows.push_back(wrongRow(frame, kind, each, times));
                });
    }
    const auto twice = doubled(frame);
    const bool many = twice.size() > mostWrongOfAKind;
    addSome(rows, twice, "twice", many ? twice[mostWrongOfAKind]->path : "",
            [&](const comms::Contested* each) {
                rows.push_back({"twice\n" + each->path,
                                each->path,
                                Shape::Contradiction,
                                {plainText(each->path), plainText(each->text)}});
            });
    return rows;
}

QString wrongCount(const Frame& frame, const Abnormal& abnormal) {
    QStringList parts;
    const auto add = [&](std::size_t count, const char* text) {
        if (count > 0) parts << onFirstPage(text).arg(countText(count));
    };
    const auto of = [&](Abnormal::Kind kind) {
        return static_cast<std::size_t>(abnormal.count(kind));
    };
    add(of(Abnormal::Fault), QT_TRANSLATE_NOOP("Overview", "%1 in Fault"));
    add(of(Abnormal::Outside), QT_TRANSLATE_NOOP("Overview", "%1 outside limits"));
    add(of(Abnormal::Lost), QT_TRANSLATE_NOOP("Overview", "%1 lost"));
    add(doubled(frame).size(), QT_TRANSLATE_NOOP("Overview", "%1 claimed twice"));
    return parts.join(QStringLiteral(", "));
}

OverviewRows controlRows(const Frame& frame) {
    std::map<std::pair<std::string, std::string>, HeldPart> parts;  // by prefix and holder
    for (const AgentFrame& agent : frame.agents) {
        for (const comms::ShownLease& each : leasesOf(agent)) {
            HeldPart& part = parts[{each.prefix, each.holder}];
            part.since = part.agents.empty() ? each.since : std::min(part.since, each.since);
            part.agents.push_back(agent.status.name);
        }
    }
    OverviewRows rows;
    for (const auto& [whose, part] : parts) {
        const auto& [prefix, holder] = whose;
        const bool ours = holder == frame.control.self;
        const QString who = ours ? onFirstPage("you: %1").arg(ownName(frame.control))
                                 : wholeNameOf(frame.control, holder);
        const QString scope = prefix == "/" ? scopeText(prefix) : plainText(prefix);
        rows.push_back({prefix + '\n' + holder,
                        prefix,
                        std::nullopt,
                        {scope, who, ofAgents(part.agents, frame.agents.size()),
                         sinceText(frame, part.since)}});
    }
    return rows;
}

QString controlNote(const Frame& frame, bool held) {
    QStringList silent;
    for (const AgentFrame& each : frame.agents)
        if (each.lost() && !each.status.ended) silent << plainText(each.status.name);
    if (!silent.isEmpty())
        return onFirstPage("Not heard, so not known of: %1.").arg(joined(silent));
    return held ? onFirstPage("All else is held by nobody.") : QString{};
}

std::optional<OverviewRow> lastRow(const EventRow& row) {
    const comms::AgentEvent& event = row.event;
    const bool wanted =
        std::ranges::any_of(lastKinds, [&](EventKind each) { return event.kind == name(each); });
    if (!wanted || row.isGap() || row.isRoutine() || isReturn(event)) return std::nullopt;
    const std::string key = event.agent + '\n' + std::to_string(event.epoch) + '\n' +
                            std::to_string(event.number) + '\n' + std::to_string(event.wallClock);
    const bool isShort = row.times == 1 && tellsOfCommand(event.kind);
    QString what = isShort ? plainText(personAlone(event.text)) : row.text();
    if (row.times > 1) what += QStringLiteral("  ×") + countText(row.times);
    const QString time = shownTimeText(event.wallClock, "HH:mm:ss");
    return OverviewRow{key,
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
