// SPDX-License-Identifier: Apache-2.0
#include "model/agent_text.hpp"

#include "common/loop_text.hpp"
#include "model/item_of.hpp"
#include "model/plain_text.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cstdint>

namespace cortex::gui {

namespace {

QString words(const char* text) { return QCoreApplication::translate("AgentText", text); }

// "38 of 40 types and 0 of 4 simplexes have come; lacking: Axis, Drive".
QString missingText(const comms::AgentStatus& agent) {
    const std::uint32_t types = std::min({agent.missingTypes, agent.types, agent.missing});
    const std::uint32_t simplexes = std::min(agent.missing - types, agent.simplexes);
    QString text = words("%1 of %2 types and %3 of %4 simplexes have come")
                       .arg(agent.types - types)
                       .arg(agent.types)
                       .arg(agent.simplexes - simplexes)
                       .arg(agent.simplexes);
    if (agent.missingNames.empty()) return text;
    QStringList names;
    for (const std::string& each : agent.missingNames) names << plainText(each);
    if (names.size() < static_cast<int>(types)) names << QStringLiteral("…");
    return words("%1; lacking: %2").arg(text, names.join(QStringLiteral(", ")));
}

}  // namespace

QString rateText(const comms::AgentStatus& agent) {
    return QString::fromStdString(common::rateText(agent));
}

QString overloadText(const comms::AgentStatus& agent) {
    if (!agent.overloaded) return {};
    if (agent.rate <= 0) return words("overloaded");
    return common::isSlow(agent) ? words("overloaded: %1").arg(rateText(agent))
                                 : words("overloaded until just now");
}

QString stateWord(const comms::AgentStatus& agent) {
    return agent.ended ? words("ended") : plainText(agent.state);
}

QString cameText(const comms::AgentStatus& agent) {
    const std::uint32_t all = agent.types + agent.simplexes;
    return words("%1 of %2").arg(all - std::min(agent.missing, all)).arg(all);
}

QString missedTicksText(const AgentFrame& agent) {
    const std::uint32_t own = agent.own();
    if (!agent.status.overloaded || own == noSimplex || !agent.came(own)) return {};
    const auto missed = itemOf<std::int64_t>(agent, own, "overflowCount");
    return missed ? words("%1 ticks missed since its start").arg(*missed) : QString{};
}

QString missedText(const AgentFrame& agent) {
    const QString text = overloadText(agent.status), ticks = missedTicksText(agent);
    return text.isEmpty() || ticks.isEmpty() ? text : words("%1; %2").arg(text, ticks);
}

int troubleRank(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    if (s.ended) return 4;
    if (agent.lost()) return 0;
    if (!s.standstill.empty()) return 1;
    if (s.overloaded) return 2;
    return s.missing > 0 ? 3 : 5;
}

QStringList troublesOf(const comms::AgentStatus& agent) {
    QStringList found;
    if (!agent.standstill.empty()) found << plainText(agent.standstill);
    if (!agent.trouble.empty()) found << plainText(agent.trouble);
    if (agent.missing > 0) found << missingText(agent);
    if (!agent.otherSelf.empty())
        found << words("not alone with its name: %1").arg(plainText(agent.otherSelf));
    if (!agent.dropped.empty())
        found << words("dropped datagrams: %1").arg(plainText(agent.dropped));
    if (!agent.refused.empty())
        found << words("refused messages: %1").arg(plainText(agent.refused));
    return found;
}

}  // namespace cortex::gui
