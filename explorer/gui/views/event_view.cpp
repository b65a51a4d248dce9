// SPDX-License-Identifier: Apache-2.0
#include "views/event_view.hpp"

#include "model/event_csv.hpp"
#include "model/event_past.hpp"
#include "model/plain_text.hpp"
#include "style/explorer_style.hpp"
#include "views/event_chips.hpp"
#include "views/event_list.hpp"
#include "views/event_panel.hpp"
#include "views/event_table.hpp"
#include "widgets/filter_keys.hpp"
#include "widgets/low_buttons.hpp"
#include "widgets/row_note.hpp"
#include "widgets/text_label.hpp"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr double leastHeight = 120;  // units, from which on there is room for all details

}  // namespace

EventView::EventView(EventFilter& events, const comms::NetworkOptions& network, EventPast* past,
                     QWidget* parent)
    : QWidget{parent},
      events_{events},
      past_{past},
      field_{new QLineEdit},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      exported_{new TextLabel{TextSize::Text}},
      reach_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      back_{new QPushButton},
      follow_{new QPushButton{tr("Follow")}},
      below_{new QPushButton{this}},
      chips_{new EventChips{events}},
      rows_{new EventTable{events}},
      trouble_{new RowNote{*rows_}},
      panel_{new EventPanel{network}} {
    setAutoFillBackground(true);
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addWidget(makeBar());
    all->addWidget(rows_, 1);
    all->addWidget(panel_);
    // Its check marks that it follows; pressed again it goes to the end again.
    follow_->setCheckable(true);
    follow_->setToolTip(tr("F or End in the rows"));
    below_->setCheckable(true);
    below_->setChecked(true);
    below_->hide();
    connect(field_, &QLineEdit::textChanged, this, &EventView::search);
    joinFilter(*field_, *rows_);
    connect(&events_, &EventFilter::changed, this, [this] {  // it may be cleared elsewhere
        const QString& text = events_.events().query().text();
        if (text != field_->text().trimmed()) field_->setText(text);
    });
    connect(follow_, &QPushButton::clicked, rows_, &EventTable::follow);
    connect(below_, &QPushButton::clicked, rows_, &EventTable::follow);
    connect(rows_, &EventTable::moved, this, &EventView::placeButton);
    connect(rows_, &EventTable::opened, this, &EventView::opened);
    connect(rows_, &EventTable::selectionSet, this, [this] {
        shown_ = rows_->selected();
        showDetails();
    });
    connect(&events_.events(), &QAbstractItemModel::modelReset, this, [this] {
        if (shown_) shown_ = events_.events().renumbered(*shown_).value_or(0);
    });
    connect(rows_, &EventTable::beforeWanted, this, &EventView::beforeWanted);
    connect(panel_, &EventPanel::beforeWanted, this, &EventView::beforeWanted);
    connect(panel_, &EventPanel::opened, this, &EventView::opened);
    field_->setText(events_.events().query().text());  // as the view before it, or the strip
    refresh();
}

QWidget* EventView::makeBar() {
    field_->setPlaceholderText(tr("Filter: words, in:/arm, severity:warning, kind:limit"));
    field_->setAccessibleName(tr("Filter of events"));
    field_->setTextMargins(Look::units(1), 0, Look::units(1), 0);
    field_->setMaximumWidth(Look::units(120));
    auto* save = new QPushButton{tr("CSV…")};
    save->setToolTip(tr("Writes the events that are shown to a file"));
    connect(save, &QPushButton::clicked, this, &EventView::askForFile);
    auto* first = new QHBoxLayout;
    first->setSpacing(Look::units(3));
    first->addWidget(field_, 3);
    for (TextLabel* each : {count_, exported_}) {  // what they say moves nothing
        each->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        first->addWidget(each, 4);
    }
    exported_->hide();
    first->addWidget(back_);
    first->addWidget(follow_);
    first->addWidget(save);
    makeBack();
    auto* bar = new QWidget;
    auto* rows = new QVBoxLayout{bar};
    rows->addLayout(first);
    rows->addWidget(chips_);
    rows->addWidget(reach_);
    bar_ = rows;
    return bar;
}

// How far back agents are asked.
void EventView::makeBack() {
    back_->setVisible(past_ != nullptr);
    reach_->setVisible(past_ != nullptr);
    if (past_ == nullptr) return;
    auto* menu = new QMenu{back_};
    for (const EventPast::Back each : EventPast::choices) {
        connect(menu->addAction(EventPast::name(each)), &QAction::triggered, this, [this, each] {
            past_->ask(each);
            tellPast();
        });
    }
    back_->setMenu(menu);
    back_->setToolTip(tr("How far back agents are asked for what they keep of the past"));
    fitBack();
}

// As wide as its longest text, so that nothing moves when another one is chosen.
void EventView::fitBack() {
    if (past_ == nullptr) return;
    int width = 0;
    for (const EventPast::Back each : EventPast::choices) {
        back_->setText(EventPast::name(each));
        width = std::max(width, back_->sizeHint().width());
    }
    if (back_->minimumWidth() != width) back_->setFixedWidth(width);
    tellPast();
}

void EventView::tellPast() {
    if (past_ == nullptr) return;
    back_->setText(EventPast::name(past_->back()));
    reach_->show(past_->reach());
}

void EventView::search() {
    const QString text = field_->text().trimmed();
    if (text != events_.events().query().text()) events_.search(text);
    const QString& trouble = events_.events().query().trouble();
    field_->setProperty(wrongInput, !trouble.isEmpty());
    field_->update();
    trouble_->show(trouble);
    refresh();
}

void EventView::refresh() {
    const QString hidden = EventList::hiddenIn(events_);
    count_->show(EventList::countOf(events_) + (hidden.isEmpty() ? hidden : "; " + hidden));
    chips_->refresh();
    tellPast();
    placeButton();
    showDetails();
}

// The details go when their row is hidden, and say so when it is no longer kept.
void EventView::showDetails() {
    if (!shown_) return;
    const EventModel& all = events_.events();
    if (*shown_ < all.first()) return panel_->sayDropped();
    if (!events_.rowOf(*shown_)) {
        shown_.reset();
        return panel_->clear();
    }
    panel_->show(all.at(static_cast<int>(*shown_ - all.first())), *shown_);
}

void EventView::placeButton() {
    follow_->setChecked(rows_->follows());
    below_->setText(tr("%1 new below").arg(countText(rows_->newBelow())));
    below_->setVisible(!rows_->follows() && rows_->newBelow() > 0);
    below_->setChecked(true);
    below_->adjustSize();
    const QRect table = rows_->geometry();
    below_->move(table.right() - below_->width() - Look::units(6),
                 table.bottom() - below_->height() - Look::units(2));
    below_->raise();
}

void EventView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    makeRoom();
    placeButton();
}

// In a low view rows come before details and chips.
void EventView::makeRoom() {
    const bool compact = height() < Look::units(leastHeight);
    const int side = Look::units(4), above = Look::units(compact ? 1 : 2);
    bar_->setContentsMargins(side, above, side, above);
    bar_->setSpacing(above);
    panel_->setCompact(compact);
    chips_->setRows(compact ? 1 : 2);
    for (QPushButton* each : findChildren<QPushButton*>()) lowerWhereLow({each});
    fitBack();
}

void EventView::focusFilter() {
    field_->setFocus();
    field_->selectAll();
}

void EventView::choose(std::uint64_t serial) {
    if (const auto row = events_.rowOf(serial)) rows_->choose(*row);
}

void EventView::askForFile() {
    auto* dialog = new QFileDialog{
        this, tr("Write the events that are shown"), {}, tr("Comma-separated values (*.csv)")};
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("csv"));
    dialog->selectFile(QStringLiteral("events.csv"));
    connect(dialog, &QFileDialog::fileSelected, this, &EventView::exportTo);
    dialog->open();
}

void EventView::exportTo(const QString& file) {
    const QString why = writeEvents(events_, file);
    exported_->show(why.isEmpty() ? tr("Written: %1").arg(file) : tr("Not written: %1").arg(why),
                    why.isEmpty() ? &Tokens::ink2 : &Tokens::warnText);
    exported_->setVisible(true);
}

}  // namespace cortex::gui
