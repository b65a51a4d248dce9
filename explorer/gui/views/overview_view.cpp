// SPDX-License-Identifier: Apache-2.0
#include "views/overview_view.hpp"

#include "model/nothing_text.hpp"
#include "model/plain_text.hpp"
#include "model/shown_time.hpp"
#include "model/wrong_rows.hpp"
#include "style/look.hpp"
#include "views/overview_part.hpp"
#include "widgets/empty_page.hpp"
#include "widgets/link.hpp"
#include "widgets/text_label.hpp"

#include <QApplication>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <utility>

namespace cortex::gui {

namespace {

using Fit = OverviewTable::Fit;

constexpr double twoColumns = 210;                 // units, from which on there are two
constexpr int leastRows = 4, leastRowsLow = 3;     // of a part, below which the page scrolls
constexpr int sinceOfControl = 3, timeOfLast = 0;  // columns whose titles have a zone

constexpr std::size_t mostNamed = 20;  // agents that are not heard

QString countOf(const OverviewRows& rows) { return countText(rows.size()); }

std::array<OverviewPart*, 4> makeParts() {
    const auto tr = [](const char* text) { return OverviewView::tr(text); };
    return {
        new OverviewPart{tr("Agents"),
                         {{tr("Agent"), Fit::Share},
                          {tr("State"), Fit::Whole, tr("lost for 59 min")},
                          {tr("Rate"), Fit::Whole, tr("1000 of 1000 Hz")},
                          {tr("Trouble"), Fit::Rest}},
                         tr("No agent is heard.")},
        new OverviewPart{tr("What is wrong"),
                         {{tr("Simplex"), Fit::Share}, {tr("What"), Fit::Rest}},
                         tr("Nothing is in Fault, outside its limits, lost, or claimed twice.")},
        new OverviewPart{tr("Who controls what"),
                         {{tr("Part"), Fit::Share},
                          {tr("Held by"), Fit::Rest},
                          {tr("Of"), Fit::Share},
                          {{}, Fit::Whole}},
                         tr("Nobody controls anything.")},
        new OverviewPart{tr("Last commands and losses"),
                         {{{}, Fit::Whole}, {tr("Path"), Fit::Share}, {tr("What"), Fit::Rest}},
                         tr("There was no command and no loss yet.")}};
}

}  // namespace

OverviewView::OverviewView(const Abnormal& abnormal, const StateTimes& times,
                           const EventModel& events, QWidget* parent)
    : QWidget{parent},
      abnormal_{abnormal},
      times_{times},
      last_{events},
      whole_{new QStackedWidget},
      empty_{new EmptyPage},
      area_{new QScrollArea},
      intro_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      allEvents_{new Link{tr("All events")}},
      note_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      parts_{makeParts()},
      introRow_{new QHBoxLayout},
      grid_{new QGridLayout} {
    setAutoFillBackground(true);
    area_->setFrameShape(QFrame::NoFrame);
    area_->setWidgetResizable(true);
    area_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area_->setFocusPolicy(Qt::NoFocus);  // what is in it has the keyboard
    area_->setWidget(makeContent());
    whole_->addWidget(empty_);
    whole_->addWidget(area_);
    auto* outer = new QVBoxLayout{this};
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(whole_);
    connect(allEvents_, &Link::clicked, this, &OverviewView::eventsOpened);
    connect(&parts_[Agents]->table(), &OverviewTable::opened, this,
            [this](const OverviewRow& row) { Q_EMIT agentOpened(row.opens); });
    connect(&parts_[Last]->table(), &OverviewTable::opened, this, &OverviewView::eventOpened);
    for (const Part each : {Wrong, InControl})
        connect(&parts_[each]->table(), &OverviewTable::opened, this, &OverviewView::openAt);
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
        if (now == nullptr || !area_->isAncestorOf(now)) return;
        for (OverviewPart* each : parts_)  // with its title
            if (each->isAncestorOf(now)) area_->ensureWidgetVisible(each, 0, 0);
    });
    arrange();
}

QWidget* OverviewView::makeContent() {
    intro_->setWordWrap(true);
    intro_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
    intro_->show(
        tr("A simplex is a part of a system: a device, a controller or an operator, with state, "
           "data and commands. The tree has them all; Ctrl+K finds one, Ctrl+G plots it. Axes are "
           "moved in the tab Jog of a controller."));
    parts_[Last]->addToTitle(*allEvents_);
    parts_[Last]->table().keepNewest();
    parts_[InControl]->addBelow(*note_);
    auto* content = new QWidget;
    auto* rows = new QVBoxLayout{content};
    introRow_->addWidget(intro_);
    rows->addLayout(introRow_);
    rows->addLayout(grid_, 1);
    return content;
}

// Agents and control at the left, what is wrong and the last events at the right.
void OverviewView::arrange() {
    const bool wide = width() >= Look::units(twoColumns);
    const bool low = Look::isLow(*this);
    const bool same = std::exchange(wide_, wide) == wide;
    for (int i = 0; i < PartCount; ++i) {
        OverviewPart* part = parts_[static_cast<std::size_t>(i)];
        part->setLeastRows(low ? leastRowsLow : leastRows);
        if (!same) grid_->addWidget(part, wide ? i / 2 : i, wide ? i % 2 : 0);
        grid_->setRowStretch(i, !wide || i < 2 ? 1 : 0);
    }
    grid_->setColumnStretch(0, 1);
    grid_->setColumnStretch(1, wide ? 1 : 0);
    grid_->setHorizontalSpacing(wide ? Look::units(4) : 0);
    grid_->setVerticalSpacing(Look::units(low ? 2 : 3));
    auto* rows = area_->widget()->layout();
    introRow_->setContentsMargins(Look::units(2), 0, Look::units(2), 0);
    const int side = Look::units(2), above = Look::units(low ? 1 : 2);
    rows->setContentsMargins(side, above, side, above);
    rows->setSpacing(above);
}

void OverviewView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void OverviewView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange) arrange();
}

void OverviewView::refresh(const std::shared_ptr<const Frame>& frame) {
    frame_ = frame;
    const auto nothing = nothingText(*frame);
    whole_->setCurrentWidget(nothing ? static_cast<QWidget*>(empty_) : area_);
    if (nothing) {
        empty_->show(nothing->title, nothing->text);
        looked_ = 0;
        return;
    }
    const bool sameZone = std::exchange(local_, showsLocalTime()) == showsLocalTime();
    if (!sameZone) last_.forget();
    if (std::exchange(looked_, abnormal_.looked()) == abnormal_.looked() && sameZone) return;
    showParts(*frame);
}

// As often as states are looked at: what comes faster cannot be read.
void OverviewView::showParts(const Frame& frame) {
    const OverviewRows agents = agentRows(frame), control = controlRows(frame);
    parts_[Agents]->show(agents, countOf(agents),
                         [&](const std::string& name) { return agentIsGone(frame, name); });
    parts_[Wrong]->show(wrongRows(frame, abnormal_, times_), wrongCount(frame, abnormal_),
                        [&](const std::string& key) { return wrongIsOver(frame, key); });
    const QString zone = zoneName(frame.utc);
    parts_[InControl]->table().setTitle(sinceOfControl, tr("Since (%1)").arg(zone));
    parts_[InControl]->show(control, countOf(control),
                            [&](const std::string&) { return controlIsGone(frame); });
    tellOfRest(frame, !control.empty());
    parts_[Last]->table().setTitle(timeOfLast, tr("Time (%1)").arg(zone));
    const OverviewRows& last = last_.update(parts_[Last]->table().isUsed());
    parts_[Last]->show(last, countOf(last));
}

// It names as many agents as there is room for.
void OverviewView::tellOfRest(const Frame& frame, bool held) {
    std::size_t named = mostNamed;
    while (named > 1 && !note_->fits(controlNote(frame, held, named))) --named;
    note_->show(controlNote(frame, held, named));
}

// What is no simplex itself, such as a prefix, leads to the first one below it.
void OverviewView::openAt(const OverviewRow& row) {
    if (row.opens.empty()) return;
    if (row.opens == "/") return Q_EMIT agentOpened({});
    if (!row.item.empty()) return Q_EMIT itemOpened(row.opens, row.item);
    const std::string found = simplexAt(*frame_, row.opens);
    Q_EMIT opened(found.empty() ? row.opens : found);
}

}  // namespace cortex::gui
