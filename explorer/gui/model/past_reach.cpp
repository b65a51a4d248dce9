// SPDX-License-Identifier: Apache-2.0
#include "model/past_reach.hpp"

#include "common/past_events.hpp"
#include "common/person_name.hpp"
#include "model/holders.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"

#include <QCoreApplication>
#include <QStringList>

namespace cortex::gui {

namespace {

constexpr int mostNamed = 12;  // agents

QString inReach(const char* text) { return QCoreApplication::translate("PastReach", text); }

std::string timeText(std::int64_t utc) {
    return timeAndZone(utc, "yyyy-MM-dd HH:mm:ss.zzz").toStdString();
}

QString agentName(const std::string& name) { return plainText(common::shownName(name)); }

QString askingText(const QStringList& names) {
    if (names.isEmpty()) return {};
    if (names.size() > 3) return inReach("asking %1 agents…").arg(names.size());
    return inReach("asking %1…").arg(joined(names));
}

QString allText(std::int64_t from) {
    if (from <= 0) return inReach("All agents have said what they keep.");
    return inReach("All agents keep what happened since %1.")
        .arg(timeAndZone(from, "yyyy-MM-dd HH:mm:ss"));
}

}  // namespace

QString reachText(const std::vector<PastReach>& agents, std::int64_t from) {
    if (agents.empty()) return {};
    QStringList asking, parts;
    for (const PastReach& each : agents) {
        if (each.asking) {
            asking << agentName(each.agent);
            continue;
        }
        QString said = plainText(each.trouble.empty()
                                     ? common::keptText(each.since, from, each.started, timeText)
                                     : each.trouble);
        if (!each.trouble.empty() && !each.remembers)
            said += inReach(": only its last 1,000 events");
        if (!said.isEmpty()) parts << QStringLiteral("%1: %2").arg(agentName(each.agent), said);
    }
    const auto left = static_cast<int>(parts.size()) - mostNamed;
    if (left > 0) {
        parts = parts.mid(0, mostNamed);
        parts << inReach("%1 more agents").arg(left);
    }
    if (!asking.isEmpty()) parts.prepend(askingText(asking));
    return parts.isEmpty() ? allText(from) : parts.join(QStringLiteral("; "));
}

}  // namespace cortex::gui
