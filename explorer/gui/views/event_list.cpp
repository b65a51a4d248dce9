// SPDX-License-Identifier: Apache-2.0
#include "views/event_list.hpp"

#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "session/utc_now.hpp"
#include "views/event_table.hpp"
#include "widgets/text_label.hpp"

#include <QApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <initializer_list>
#include <limits>

namespace cortex::gui {

namespace {

constexpr int secondsLeft = 5;  // until it follows again

}  // namespace

EventList::EventList(EventFilter& events, QWidget* parent)
    : QWidget{parent},
      events_{events},
      rows_{new EventTable{events}},
      title_{new TextLabel{TextSize::Text, true}},
      filter_{new TextLabel{TextSize::Text, false, &Tokens::accent}},
      hidden_{new TextLabel{TextSize::Text, true, &Tokens::faultText}},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      before_{new QPushButton{tr("Ten seconds before")}},
      showAll_{new QPushButton{tr("Show all")}},
      new_{new QPushButton},
      head_{makeHead()} {
    rows_->horizontalHeader()->hide();
    setAutoFillBackground(true);
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addWidget(head_);
    all->addWidget(rows_, 1);
    left_.setInterval(1000);
    fit();
    tellCount();
    tellNew();
    // Also of events that the filter hides.
    for (QAbstractItemModel* each :
         std::initializer_list<QAbstractItemModel*>{&events.events(), &events}) {
        connect(each, &QAbstractItemModel::rowsInserted, this, &EventList::tellCount);
        connect(each, &QAbstractItemModel::rowsRemoved, this, &EventList::tellCount);
        connect(each, &QAbstractItemModel::dataChanged, this, &EventList::tellCount);
    }
    connect(&events, &EventFilter::changed, this, &EventList::tellCount);
    connect(&events.events(), &QAbstractItemModel::headerDataChanged, this, &EventList::tellCount);
    connect(rows_, &EventTable::opened, this, &EventList::opened);
    connect(rows_, &EventTable::beforeWanted, this, &EventList::beforeWanted);
    connect(rows_, &EventTable::selectionSet, this, &EventList::tellBefore);
    connect(rows_, &EventTable::selectionDropped, this, &EventList::tellBefore);
    connect(before_, &QPushButton::clicked, this, [this] {
        if (const auto* fault = rows_->selectedFault()) Q_EMIT beforeWanted(*fault);
    });
    connect(rows_, &EventTable::moved, this, &EventList::tellNew);
    connect(showAll_, &QPushButton::clicked, &events, &EventFilter::showAll);
    connect(new_, &QPushButton::clicked, rows_, &EventTable::follow);
    connect(&left_, &QTimer::timeout, this, &EventList::lookWhetherLeft);
}

// The buttons stand at the end, and one that is not needed leaves its place free.
QWidget* EventList::makeHead() {
    new_->setCheckable(true);  // blue
    new_->setToolTip(tr("To the newest: F or End in the rows"));
    showAll_->setToolTip(tr("Takes the filter of all events away"));
    before_->setToolTip(tr("What all agents say of the ten seconds before it: Enter in the rows"));
    for (QPushButton* each : {before_, showAll_, new_}) {
        each->setFocusPolicy(Qt::TabFocus);
        each->hide();
    }
    auto* head = new QWidget;
    auto* row = new QHBoxLayout{head};
    row->setContentsMargins(Look::units(3), 0, Look::units(3), 0);
    row->setSpacing(Look::units(4));
    for (QWidget* each : std::initializer_list<QWidget*>{title_, filter_, hidden_, count_}) {
        row->addWidget(each);
    }
    row->addStretch(1);
    row->addWidget(new_);
    for (QPushButton* each : {before_, showAll_}) {
        row->addWidget(each);
        QSizePolicy kept = each->sizePolicy();
        kept.setRetainSizeWhenHidden(true);
        each->setSizePolicy(kept);
    }
    return head;
}

// Its height is the same with and without buttons.
void EventList::fit() {
    const int height = Look::units(7.5);
    if (head_->maximumHeight() == height) return;
    head_->setFixedHeight(height);
    for (QPushButton* each : {before_, showAll_, new_})
        each->setFixedHeight(height - Look::units(1.5));
}

void EventList::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange) fit();
}

QString EventList::countOf(const EventFilter& events) {
    const EventModel& all = events.events();
    if (all.count() == 0) return tr("none yet");
    const std::uint64_t kept = all.count() - all.dropped();
    const std::uint64_t shown = events.counts().shown;
    QString text = shown == kept ? tr("%1 so far, all agents").arg(countText(all.count()))
                                 : tr("%1 of %2 shown").arg(countText(shown), countText(kept));
    if (all.dropped() > 0) {
        text += tr("; %1 older ones are no longer kept").arg(countText(all.dropped()));
    }
    return text;
}

QString EventList::hiddenIn(const EventFilter& events) {
    constexpr std::uint64_t most = std::numeric_limits<int>::max();
    const auto hidden = static_cast<int>(std::min(events.counts().hiddenErrors, most));
    return hidden == 0 ? QString{} : tr("%n faults or errors not shown", nullptr, hidden);
}

// The rows have no title that could name the zone.
void EventList::tellCount() {
    title_->show(tr("Events (%1)").arg(zoneName(utcNow())));
    filter_->show(events_.text());
    filter_->setVisible(!filter_->text().isEmpty());
    showAll_->setVisible(!filter_->text().isEmpty());
    hidden_->show(hiddenIn(events_));
    hidden_->setVisible(!hidden_->text().isEmpty());
    count_->show(countOf(events_));
}

void EventList::tellNew() {
    new_->setText(tr("%1 new").arg(countText(rows_->newBelow())));
    new_->setVisible(!rows_->follows() && rows_->newBelow() > 0);
    new_->setChecked(true);
    if (rows_->follows()) {
        left_.stop();
    } else if (!left_.isActive()) {
        away_ = 0;
        left_.start();
    }
}

void EventList::tellBefore() { before_->setVisible(rows_->selectedFault() != nullptr); }

void EventList::lookWhetherLeft() {
    const QWidget* focused = QApplication::focusWidget();
    const bool inside = underMouse() || (focused != nullptr && isAncestorOf(focused));
    away_ = inside ? 0 : away_ + 1;
    if (away_ >= secondsLeft) rows_->follow();
}

}  // namespace cortex::gui
