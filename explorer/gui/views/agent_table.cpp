// SPDX-License-Identifier: Apache-2.0
#include "views/agent_table.hpp"

#include "model/agent_text.hpp"
#include "model/shown_time.hpp"
#include "model/value_text.hpp"
#include "widgets/rows.hpp"

#include <QHeaderView>
#include <QScrollBar>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int nameRole = Qt::UserRole, startedColumn = 4, troubleColumn = 11;

QStringList textsOf(const AgentFrame& agent) {
    const comms::AgentStatus& s = agent.status;
    const QStringList troubles = troublesOf(s);
    return {QString::fromStdString(s.name),
            QString::fromStdString(s.host),
            stateWord(s),
            ageText(s.age),
            shownTimeText(s.epoch * 1000, "yyyy-MM-dd HH:mm:ss"),
            rateText(s),
            QString::number(s.cycle),
            QString::number(s.simplexes),
            QString::number(s.types),
            QString::number(s.loss),
            QString::fromStdString(s.security),
            troubles.isEmpty() ? missedText(agent) : troubles.front()};
}

}  // namespace

AgentTable::AgentTable(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setRootIsDecorated(false);
    setAccessibleName(tr("Agents"));
    setHeaderLabels({tr("Agent"), tr("Host"), tr("State"), tr("Age"), QString{}, tr("Rate"),
                     tr("Cycle"), tr("Simplexes"), tr("Types"), tr("Lost samples"), tr("Security"),
                     tr("Trouble")});
    keepWidths(*this, {28.0, 34.0, 24.0, 18.0, 44.0, 20.0, 24.0, 20.0, 16.0, 26.0, 28.0});
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
    const int count = static_cast<int>(frame.agents.size());
    const bool other = topLevelItemCount() != count;
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    while (topLevelItemCount() < count) new QTreeWidgetItem{this};
    for (int i = 0; i < topLevelItemCount(); ++i) {
        const AgentFrame& agent = frame.agents[static_cast<std::size_t>(i)];
        const QStringList texts = textsOf(agent);
        topLevelItem(i)->setData(0, nameRole, QString::fromStdString(agent.status.name));
        for (int column = 0; column < texts.size(); ++column) {
            setCell(*topLevelItem(i), column, texts[column]);
        }
    }
    filling_ = false;
    for (int column = 0; column < troubleColumn; ++column) growToFit(*this, column);
    mark();
    if (other) updateGeometry();
}

int AgentTable::wholeHeight() const {
    const int rows = std::max(topLevelItemCount(), 1);
    return header()->sizeHint().height() + rows * gui::rowHeight() +
           horizontalScrollBar()->sizeHint().height();
}

}  // namespace cortex::gui
