// SPDX-License-Identifier: Apache-2.0
#include "views/event_panel.hpp"

#include "common/shell_line.hpp"
#include "common/utc_text.hpp"
#include "model/event_details.hpp"
#include "widgets/state_mark.hpp"
#include "widgets/text_label.hpp"

#include <QGridLayout>
#include <QPainter>
#include <QPushButton>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace cortex::gui {

namespace {

constexpr int pairsInColumn = 6;

// The same for a shell: also what only the agent's memory has. Of a fault what was before it.
QString shellCommand(const EventRow& row, const comms::NetworkOptions& network) {
    constexpr std::int64_t second = 1'000'000'000;
    const auto timeText = [](std::int64_t time) { return common::utcText(time, 0); };
    std::vector<std::string> words{"events"};
    if (!row.event.path.empty()) words.push_back(row.event.path);
    if (row.event.kind == name(EventKind::Fault)) {
        words.emplace_back("--before-fault");
    } else {
        words.insert(words.end(), {"--since", timeText(row.event.wallClock)});
    }
    words.insert(words.end(), {"--until", timeText(row.newest().wallClock + second)});
    if (row.event.kind != name(EventKind::Fault) && row.event.severity != Severity::Info) {
        words.insert(words.end(), {"--severity", name(row.event.severity)});
    }
    return QString::fromStdString(common::shellLine(words, network));
}

}  // namespace

EventPanel::EventPanel(comms::NetworkOptions network, QWidget* parent)
    : QWidget{parent},
      network_{std::move(network)},
      mark_{new StateMark{4}},
      title_{new TextLabel{TextSize::Text, true}},
      dropped_{new TextLabel{TextSize::Text, true, &Tokens::dataText}},
      command_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      before_{new QPushButton{tr("Ten seconds before")}},
      open_{new QPushButton{tr("Show in tree")}},
      more_{new QWidget} {
    setAutoFillBackground(true);
    setAccessibleName(tr("Details"));
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    auto* head = new QHBoxLayout;
    head->setSpacing(Look::units(2));
    title_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    head->addWidget(mark_);
    head->addWidget(title_, 1);
    head->addWidget(dropped_);
    head->addWidget(before_);
    head->addWidget(open_);
    auto* rows = new QVBoxLayout{this};
    rows->setSpacing(Look::units(1));
    rows->addLayout(head);
    rows->addWidget(more_);
    addPairs();
    connect(open_, &QPushButton::clicked, this, [this] { Q_EMIT opened(event_.path); });
    connect(before_, &QPushButton::clicked, this, [this] { Q_EMIT beforeWanted(event_); });
    before_->setToolTip(tr("What all agents say of the ten seconds before it: Enter in the rows"));
    // Their places are kept.
    for (QWidget* each : std::initializer_list<QWidget*>{mark_, before_, open_}) {
        QSizePolicy policy = each->sizePolicy();
        policy.setRetainSizeWhenHidden(true);
        each->setSizePolicy(policy);
    }
    clear();
    setCompact(false);
}

void EventPanel::addPairs() {
    auto* grid = new QGridLayout{more_};
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(Look::units(4));
    grid->setVerticalSpacing(Look::units(0.5));
    grid->setColumnStretch(1, 1);
    grid->setColumnStretch(3, 1);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        auto& [name, text] = pairs_[i];
        name = new TextLabel{TextSize::Note, false, &Tokens::ink2};
        text = new TextLabel{TextSize::Note};
        text->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        const int number = static_cast<int>(i), column = 2 * (number / pairsInColumn);
        grid->addWidget(name, number % pairsInColumn, column);
        grid->addWidget(text, number % pairsInColumn, column + 1);
    }
    grid->addWidget(command_, pairsInColumn, 0, 1, 4);
}

void EventPanel::setCompact(bool compact) {
    const int side = Look::units(4), above = Look::units(compact ? 0.5 : 2);
    layout()->setContentsMargins(side, above, side, above);
    more_->setVisible(!compact);
}

void EventPanel::clear() {
    serial_.reset();
    for (QWidget* each : std::initializer_list<QWidget*>{mark_, before_, open_}) each->hide();
    for (const auto& [name, text] : pairs_) {
        name->show({});
        text->show({});
    }
    title_->show(tr("Choose an event."), &Tokens::ink2);
    dropped_->show({});
    command_->show({});
}

void EventPanel::show(const EventRow& row, std::uint64_t serial) {
    const comms::AgentEvent& event = row.event;
    dropped_->show({});
    if (serial_ == serial && times_ == row.times) return;
    serial_ = serial;
    times_ = row.times;
    event_ = event;
    mark_->show(row.isGap() ? Shape::Bad : shapeOf(event.severity));
    title_->show(row.text(), row.isGap() ? &Tokens::dataText : &Tokens::ink);
    mark_->setVisible(true);
    open_->setVisible(!event_.path.empty());
    before_->setVisible(row.isFault());
    command_->show(tr("As a command: %1").arg(shellCommand(row, network_)));
    fill(row);
}

void EventPanel::fill(const EventRow& row) {
    const EventDetails details = detailsOf(row);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const bool used = i < details.size();
        pairs_[i].first->show(used ? details[i].first : QString{});
        pairs_[i].second->show(used ? details[i].second : QString{});
    }
}

void EventPanel::sayDropped() { dropped_->show(tr("no longer kept")); }

void EventPanel::paintEvent(QPaintEvent* /*event*/) {
    QPainter{this}.fillRect(QRect{0, 0, width(), 1}, Look::colours().line);
}

}  // namespace cortex::gui
