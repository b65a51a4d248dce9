// SPDX-License-Identifier: Apache-2.0
#include "views/event_list.hpp"

#include "model/plain_text.hpp"
#include "views/event_table.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QVBoxLayout>

namespace cortex::gui {

EventList::EventList(EventFilter& events, QWidget* parent)
    : QWidget{parent},
      events_{events},
      rows_{new EventTable{events}},
      filter_{new TextLabel{TextSize::Text, false, &Tokens::accent}},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}} {
    auto* title = new TextLabel{TextSize::Text, true};
    title->show(tr("Events"));
    auto* head = new QHBoxLayout;
    head->setContentsMargins(Look::units(3), Look::units(1.5), Look::units(3), Look::units(1.5));
    head->setSpacing(Look::units(4));
    head->addWidget(title);
    head->addWidget(filter_);
    head->addWidget(count_);
    head->addStretch(1);
    rows_->horizontalHeader()->hide();
    setAutoFillBackground(true);
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addLayout(head);
    all->addWidget(rows_, 1);
    tellCount();
    for (const auto signal : {&EventFilter::rowsInserted, &EventFilter::rowsRemoved}) {
        connect(&events, signal, this, &EventList::tellCount);
    }
    connect(&events, &EventFilter::dataChanged, this, &EventList::tellCount);
    connect(&events, &EventFilter::changed, this, &EventList::tellCount);
    connect(rows_, &EventTable::opened, this, &EventList::opened);
}

QString EventList::countOf(const EventFilter& events) {
    const EventModel& all = events.events();
    if (all.count() == 0) return tr("none yet");
    const std::uint64_t kept = all.count() - all.dropped();
    const std::uint64_t shown = events.counts().shown;
    QString text = shown == kept ? tr("%1 so far, all agents").arg(countText(all.count()))
                                 : tr("%1 of %2 shown").arg(countText(shown), countText(kept));
    if (all.dropped() > 0) {
        text += tr("; the oldest %1 are no longer kept").arg(countText(all.dropped()));
    }
    return text;
}

void EventList::tellCount() {
    filter_->show(events_.text());
    filter_->setVisible(!filter_->text().isEmpty());
    count_->show(countOf(events_));
}

}  // namespace cortex::gui
