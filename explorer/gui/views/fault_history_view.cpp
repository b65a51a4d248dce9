// SPDX-License-Identifier: Apache-2.0
#include "views/fault_history_view.hpp"

#include "model/plain_text.hpp"
#include "style/shapes.hpp"
#include "widgets/rows.hpp"
#include "widgets/state_mark.hpp"
#include "widgets/text_label.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QScrollBar>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

enum HistoryColumn { SecondsColumn, WhatKind, WherePath, WhatText };

constexpr std::array<double, 3> columnUnits{24, 26, 30};  // a long path leaves room for the text
constexpr double patienceWithAgents = 5;                  // s, until all have come

}  // namespace

FaultHistoryView::FaultHistoryView(comms::AgentEvent fault, EventPast& past, QWidget* parent)
    : QWidget{parent},
      history_{std::move(fault)},
      past_{past},
      mark_{new StateMark{4}},
      title_{new TextLabel{TextSize::Text, true}},
      text_{new TextLabel{TextSize::Text, false, &Tokens::faultText}},
      reachText_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      rows_{new QTreeWidget} {
    setAutoFillBackground(true);
    mark_->show(Shape::Fault);
    title_->show(history_.title());
    text_->show(plainText(history_.fault().text));
    reachText_->show(tr("Asking all agents for what they keep…"));
    setUpRows(*rows_);
    rows_->setRootIsDecorated(false);
    rows_->setAccessibleName(tr("The ten seconds before"));
    rows_->setHeaderLabels({tr("Before"), tr("Kind"), tr("Path"), tr("What")});
    rows_->headerItem()->setTextAlignment(SecondsColumn, Qt::AlignRight | Qt::AlignVCenter);
    connect(rows_, &QTreeWidget::itemActivated, this, [this](const QTreeWidgetItem* row) {
        const std::string path = row->data(WherePath, Qt::UserRole).toString().toStdString();
        if (!path.empty()) Q_EMIT opened(path);
    });
    auto* head = new QHBoxLayout;
    head->setContentsMargins(Look::units(4), Look::units(1), Look::units(4), 0);
    head->setSpacing(Look::units(2));
    head->addWidget(mark_);
    head->addWidget(title_);
    head->addWidget(text_, 1);
    head->addStretch(0);
    auto* line = new QHBoxLayout;
    line->setContentsMargins(Look::units(4), 0, Look::units(4), Look::units(1));
    line->addWidget(reachText_);
    line->addStretch(1);
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(Look::units(1));
    all->addLayout(head);
    all->addLayout(line);
    all->addWidget(rows_, 1);
    setWidths(*rows_, columnUnits);
    setFocusProxy(rows_);
}

// Whoever had the fault is asked also where it is not known any more: then it says so.
void FaultHistoryView::ask(const Frame& frame) {
    asked_ = true;
    bool known = false;
    for (const AgentFrame& each : frame.agents) {
        const comms::AgentStatus& status = each.status;
        known = known || status.name == history_.fault().agent;
        askOne(status.name, status.epoch * 1000, status.remembers || each.lost());
    }
    if (!known) askOne(history_.fault().agent, history_.fault().epoch * 1000, true);
}

void FaultHistoryView::askOne(const std::string& agent, std::int64_t started, bool remembers) {
    const std::size_t place = reach_.size();
    reach_.push_back({agent, started, remembers, true, {}, {}});
    past_.past().ask(agent, history_.begin(), history_.fault().wallClock, this,
                     [this, place](comms::PastEvents past) { take(place, std::move(past)); });
}

void FaultHistoryView::take(std::size_t place, comms::PastEvents past) {
    PastReach& reach = reach_[place];
    reach.asking = false;
    reach.trouble = std::move(past.trouble);
    reach.since = std::move(past.since);
    std::ranges::move(past.events, std::back_inserter(kept_));
}

void FaultHistoryView::refresh(const Frame& frame) {
    if (shown_) return;
    const bool allCame = frame.complete || frame.seconds > patienceWithAgents;
    if (!asked_ && frame.joined && allCame) ask(frame);
    if (!asked_) return;
    reachText_->show(reachText(reach_, history_.begin()));
    if (std::ranges::none_of(reach_, &PastReach::asking)) showRows();
}

void FaultHistoryView::showRows() {
    shown_ = true;
    history_.show(past_.events(), std::exchange(kept_, {}));
    if (history_.left() > 0) {
        reachText_->show(tr("%1 older rows have no room here. %2")
                             .arg(countText(history_.left()), reachText_->text()));
    }
    for (const EventRow& each : history_.rows()) addRow(each, &each == &history_.rows().back());
    tellWhole(*rows_);
    dress();
    rows_->scrollToBottom();
}

void FaultHistoryView::addRow(const EventRow& row, bool isFault) {
    QString text = row.text();
    if (row.times > 1) text += QStringLiteral("  ×%1").arg(countText(row.times));
    const QString seconds = history_.secondsOf(row);
    auto* item = new QTreeWidgetItem{
        rows_, {seconds, plainText(row.event.kind), plainText(row.event.path), text}};
    item->setTextAlignment(SecondsColumn, Qt::AlignRight | Qt::AlignVCenter);
    item->setData(WherePath, Qt::UserRole, QString::fromStdString(row.event.path));
    item->setData(SecondsColumn, Qt::UserRole, isFault);
}

// In the look that applies now: the fault is marked by its shape, in strong letters and in red.
void FaultHistoryView::dress() {
    const Tokens& c = Look::colours();
    const int size = markSize();
    for (int i = 0; i < rows_->topLevelItemCount(); ++i) {
        QTreeWidgetItem& row = *rows_->topLevelItem(i);
        const bool isFault = row.data(SecondsColumn, Qt::UserRole).toBool();
        row.setForeground(WherePath, c.accent);
        if (!isFault) continue;
        QPixmap mark{size, size};
        mark.fill(Qt::transparent);
        QPainter painter{&mark};
        paint(painter, QRectF{QPointF{}, QSizeF{mark.size()}}, Shape::Fault, c);
        painter.end();
        row.setIcon(WhatKind, QIcon{mark});
        for (const int column : {SecondsColumn, WhatKind, WhatText}) {
            row.setFont(column, Look::font(TextSize::Text, true));
            row.setForeground(column, c.faultText);
        }
    }
}

void FaultHistoryView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange || rows_ == nullptr) return;
    setWidths(*rows_, columnUnits);
    dress();
}

}  // namespace cortex::gui
