// SPDX-License-Identifier: Apache-2.0
#include "views/agent_table.hpp"

#include "common/role_meaning.hpp"
#include "model/agent_text.hpp"
#include "model/shown_time.hpp"
#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <QHeaderView>
#include <QScrollBar>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int nameRole = Qt::UserRole, startedColumn = 4, simplexesColumn = 7, troubleColumn = 11;

// The day too, where it is another one than that of `now`.
QString startText(std::int64_t started, std::int64_t now) {
    const char* const day = "yyyy-MM-dd";
    const bool today = shownTimeText(started, day) == shownTimeText(now, day);
    return shownTimeText(started, today ? "HH:mm:ss" : "yyyy-MM-dd HH:mm:ss");
}

QStringList textsOf(const AgentFrame& agent, std::int64_t utc) {
    const comms::AgentStatus& s = agent.status;
    const QStringList troubles = troublesOf(s);
    return {QString::fromStdString(s.name),
            QString::fromStdString(s.host),
            stateWord(s),
            ageText(s.age),
            startText(s.epoch * 1000, utc),
            rateText(s),
            QString::number(s.cycle),
            QString::number(s.simplexes),
            QString::number(s.types),
            QString::number(s.loss),
            QString::fromStdString(s.security),
            troubles.isEmpty() ? missedText(agent) : troubles.front()};
}

QStringList goneAgentTexts(const std::string& name) {
    QStringList texts{QString::fromStdString(name)};
    while (texts.size() < troubleColumn) texts << QStringLiteral("—");
    return texts << AgentTable::tr("It is not heard.");
}

}  // namespace

AgentTable::AgentTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("Agents"));
    setHeaderLabels({tr("Agent"), tr("Host"), tr("State"), tr("Age"), QString{}, tr("Rate"),
                     tr("Cycle"), tr("Simplexes"), tr("Types"), tr("Lost samples"), tr("Security"),
                     tr("Trouble")});
    headerItem()->setToolTip(simplexesColumn, tr(common::simplexMeaning));
    keepWidths(*this, {28.0, 20.0, 22.0, 16.0, 28.0, 20.0, 24.0, 20.0, 16.0, 26.0, 28.0});
    connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* now) {
        if (filling_ || now == nullptr) return;
        chosen_ = now->data(0, nameRole).toString().toStdString();
        Q_EMIT chosen(chosen_);
    });
}

void AgentTable::choose(const std::string& agent) {
    chosen_ = agent;
    mark();
}

// The row of the agent that is chosen, wherever it stands now.
void AgentTable::mark() {
    filling_ = true;
    QTreeWidgetItem* wanted = nullptr;
    for (int i = 0; i < topLevelItemCount(); ++i) {
        if (topLevelItem(i)->data(0, nameRole).toString().toStdString() == chosen_)
            wanted = topLevelItem(i);
    }
    if (wanted != currentItem()) setCurrentItem(wanted);
    filling_ = false;
}

void AgentTable::refresh(const Frame& frame) {
    const QString started = tr("Started (%1)").arg(zoneName(frame.utc));
    if (headerItem()->text(startedColumn) != started) headerItem()->setText(startedColumn, started);
    filling_ = true;
    std::vector<std::string> names;
    for (const AgentFrame& each : frame.agents) names.push_back(each.status.name);
    const std::vector<int> places = order_.update(names, isUsed(*this));
    const int count = static_cast<int>(places.size());
    const bool other = topLevelItemCount() != count;
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    while (topLevelItemCount() < count) new QTreeWidgetItem{this};
    for (int row = 0; row < count; ++row) {
        const int place = places[static_cast<std::size_t>(row)];
        const QStringList texts =
            place == HeldOrder::gone
                ? goneAgentTexts(order_.key(row))
                : textsOf(frame.agents[static_cast<std::size_t>(place)], frame.utc);
        topLevelItem(row)->setData(0, nameRole, QString::fromStdString(order_.key(row)));
        for (int column = 0; column < texts.size(); ++column)
            setCell(*topLevelItem(row), column, texts[column]);
    }
    filling_ = false;
    for (int column = 0; column < troubleColumn; ++column) growToFit(*this, column);
    mark();
    if (other) updateGeometry();
}

int AgentTable::heightOf(int rows) const {
    return header()->sizeHint().height() + std::max(rows, 1) * gui::rowHeight() +
           horizontalScrollBar()->sizeHint().height();
}

}  // namespace cortex::gui
