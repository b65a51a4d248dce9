// SPDX-License-Identifier: Apache-2.0
#include "views/agent_table.hpp"

#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <QDateTime>
#include <QTimeZone>

namespace cortex::explorer {

namespace {

QString troubleOf(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    if (!s.standstill.empty()) return QString::fromStdString(s.standstill);
    if (!s.trouble.empty()) return QString::fromStdString(s.trouble);
    if (s.missing > 0) {
        return AgentTable::tr("%1 of %2 simplexes have come")
            .arg(s.simplexes - s.missing)
            .arg(s.simplexes);
    }
    return {};
}

// Of its period, and what it reaches where that is less.
QString rateOf(const comms::AgentStatus& s) {
    if (s.period <= 0) return {};
    const double wanted = 1e9 / static_cast<double>(s.period);
    if (!s.overloaded || s.rate <= 0) return AgentTable::tr("%1 Hz").arg(wanted, 0, 'g', 6);
    return AgentTable::tr("%1 of %2 Hz").arg(s.rate, 0, 'g', 4).arg(wanted, 0, 'g', 6);
}

}  // namespace

AgentTable::AgentTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("Agents"));
    setHeaderLabels({tr("Agent"), tr("Host"), tr("State"), tr("Age"), tr("Started (UTC)"),
                     tr("Rate"), tr("Cycle"), tr("Simplexes"), tr("Types"), tr("Lost samples"),
                     tr("Security"), tr("Trouble")});
    setWidths(*this, {28.0, 34.0, 24.0, 18.0, 40.0, 20.0, 24.0, 20.0, 16.0, 26.0, 28.0});
}

void AgentTable::refresh(const Frame& frame) {
    while (topLevelItemCount() > static_cast<int>(frame.agents.size())) delete takeTopLevelItem(0);
    while (topLevelItemCount() < static_cast<int>(frame.agents.size())) new QTreeWidgetItem{this};
    for (int i = 0; i < topLevelItemCount(); ++i) {
        const AgentFrame& agent = frame.agents[static_cast<std::size_t>(i)];
        const comms::AgentStatus& s = agent.status;
        const auto started = QDateTime::fromMSecsSinceEpoch(s.epoch / 1000, QTimeZone::utc());
        const QStringList texts{QString::fromStdString(s.name),
                                QString::fromStdString(s.host),
                                s.ended ? tr("ended") : QString::fromStdString(s.state),
                                ageText(s.age),
                                started.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")),
                                rateOf(s),
                                QString::number(s.cycle),
                                QString::number(s.simplexes),
                                QString::number(s.types),
                                QString::number(s.loss),
                                QString::fromStdString(s.security),
                                troubleOf(agent)};
        for (int column = 0; column < texts.size(); ++column) {
            setCell(*topLevelItem(i), column, texts[column]);
        }
    }
}

}  // namespace cortex::explorer
