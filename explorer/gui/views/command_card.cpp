// SPDX-License-Identifier: Apache-2.0
#include "views/command_card.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "model/shell_text.hpp"
#include "model/value_text.hpp"
#include "views/run_question.hpp"
#include "widgets/popover.hpp"
#include "widgets/text_label.hpp"
#include "widgets/value_field.hpp"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds shortLimit = 5s, longLimit = std::chrono::hours{24};

QString boundText(const DataItem& item, const std::optional<Number>& bound, const char* none) {
    return bound ? numberText(item, *numberOf(bound)) : QString::fromUtf8(none);
}

// "0.01 to 1 rad"; without a range the unit alone.
QString rangeAndUnit(const DataItem& item) {
    QStringList parts;
    if (item.min || item.max) {
        parts << CommandCard::tr("%1 to %2")
                     .arg(boundText(item, item.min, "−∞"), boundText(item, item.max, "∞"));
    }
    if (!item.unit.empty()) parts << unitText(item.unit);
    if (item.length > 1) {
        parts << CommandCard::tr("%n values", nullptr, static_cast<int>(item.length));
    }
    return parts.join(' ');
}

QLabel* selectable(const QString& text) {
    auto* label = new QLabel;
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    label->setText(text);
    return label;
}

void keepPlace(QWidget& widget) {
    QSizePolicy policy = widget.sizePolicy();
    policy.setRetainSizeWhenHidden(true);
    widget.setSizePolicy(policy);
}

}  // namespace

CommandCard::CommandCard(Commands& commands, std::string path, const Command& command,
                         QWidget* parent)
    : QWidget{parent},
      commands_{commands},
      path_{std::move(path)},
      command_{command},
      run_{new QPushButton{tr("Run")}},
      whole_{new QPushButton{tr("Whole answer…")}},
      cancel_{new QPushButton{tr("Cancel")}},
      told_{new TextLabel{TextSize::Note}},
      reason_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      progressText_{new TextLabel{TextSize::Text}},
      progress_{new QProgressBar} {
    const QString name = QString::fromStdString(command_.name);
    setAccessibleName(name);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(Look::units(4), Look::units(2), Look::units(4), Look::units(3));
    auto* title = new TextLabel{TextSize::Text, true};
    title->show(name);
    rows->addWidget(title);
    rows->addWidget(selectable(QString::fromStdString(command_.description)));

    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(Look::units(3));
    grid->setColumnStretch(3, 1);
    for (const DataItem& each : command_.request) addParameter(*grid, each);
    rows->addLayout(grid);
    addRun(*rows);
    addCancel(*rows);
    addCopy();
    fit();
    showOutcomes();
    decide();
}

// Beside Run what became of the last one, below it why it is off.
void CommandCard::addRun(QVBoxLayout& rows) {
    run_->setAccessibleName(tr("Run %1").arg(accessibleName()));
    run_->setToolTip(tr("Ctrl+Enter in this form"));
    told_->setWordWrap(true);
    told_->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    told_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    whole_->setAccessibleName(tr("Whole answer to %1").arg(accessibleName()));
    keepPlace(*whole_);
    whole_->hide();
    auto* row = new QHBoxLayout;
    row->addWidget(run_);
    row->addWidget(told_, 1);
    row->addWidget(whole_);
    auto* both = new QVBoxLayout;
    both->setSpacing(Look::units(0.5));
    both->addLayout(row);
    both->addWidget(reason_);
    rows.addLayout(both);
    connect(run_, &QPushButton::clicked, this, &CommandCard::run);
    connect(whole_, &QPushButton::clicked, this, &CommandCard::openAnswer);
}

void CommandCard::addCancel(QVBoxLayout& rows) {
    cancel_->setAccessibleName(tr("Cancel %1").arg(accessibleName()));
    progress_->setTextVisible(false);
    progress_->setFixedSize(Look::units(40), Look::units(3));
    if (command_.isLong) keepPlace(*cancel_);
    auto* row = new QHBoxLayout;
    row->addWidget(cancel_);
    row->addWidget(progress_);
    row->addWidget(progressText_);
    row->addStretch(1);
    rows.addLayout(row);
    for (QWidget* each : std::initializer_list<QWidget*>{cancel_, progress_, progressText_})
        each->hide();
    connect(cancel_, &QPushButton::clicked, this, &CommandCard::cancel);
}

void CommandCard::addCopy() {
    auto* copy = new QAction{tr("Copy as cortex command"), this};
    connect(copy, &QAction::triggered, this, [this] {
        QApplication::clipboard()->setText(
            shellText(commands_.network(), "call", path_, command_.name, arguments()));
    });
    addAction(copy);
    setContextMenuPolicy(Qt::ActionsContextMenu);
}

// Room for two lines of an answer, whether there is one or not.
void CommandCard::fit() {
    const int height = told_->heightOfLines(2);
    if (height != told_->minimumHeight()) told_->setFixedHeight(height);
}

void CommandCard::addParameter(QGridLayout& grid, const DataItem& item) {
    const int row = grid.rowCount();
    auto* name = new TextLabel{TextSize::Text};
    name->show(QString::fromStdString(item.name));
    auto* field = new ValueField{item};
    field->setFixedWidth(Look::units(60));
    auto* range = new TextLabel{TextSize::Text, false, &Tokens::ink2};
    range->show(rangeAndUnit(item));
    auto* about = new TextLabel{TextSize::Text, false, &Tokens::ink2};
    about->show(QString::fromStdString(item.description));
    about->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    grid.addWidget(name, row, 0, Qt::AlignLeft);
    grid.addWidget(field, row, 1);
    grid.addWidget(range, row, 2, Qt::AlignLeft);
    grid.addWidget(about, row, 3);
    fields_.push_back(field);
    const TypedArguments::Key key{path_, command_.name, item.name};
    if (const QString typed = commands_.typed().of(key, item); !typed.isEmpty())
        field->setText(typed);
    connect(field, &ValueField::changed, this, [this, field, key, item] {
        commands_.typed().keep(key, item, field->text());
        decide();
    });
}

void CommandCard::refresh(const Frame& frame, Place place) {
    owner_ = startOf(frame.agents[place.agent]);
    whyNot_ = comms::isControlCommand(command_.name)
                  ? tr("the window does this itself: Ctrl+T")
                  : whyNotNow(frame, place, command_.available, command_.name, arguments());
    fit();
    showOutcomes();
    decide();
    if (command_.isLong) refreshProgress(frame.agents[place.agent], place.simplex);
}

// Agents let everybody cancel, as they let everybody stop. Of a lost one the last that was heard.
void CommandCard::refreshProgress(const AgentFrame& agent, std::uint32_t simplex) {
    const auto activity = activityOf(agent, simplex);
    const bool known = activity && !agent.lost();
    if (known) {
        runs_ = activity->runs && activity->command == QString::fromStdString(command_.name);
    }
    for (QWidget* each : std::initializer_list<QWidget*>{progress_, progressText_, cancel_}) {
        each->setVisible(runs_);
    }
    const Commands::Last* sent = commands_.last(path_, cancelName());
    const bool waits = sent != nullptr && !sent->outcome;
    const QString why = agent.lost()
                            ? tr("%1 is not heard").arg(QString::fromStdString(agent.status.name))
                        : waits ? tr("sending")
                                : QString{};
    cancel_->setEnabled(why.isEmpty());
    if (!runs_) return;
    if (known) {
        const int percent = static_cast<int>(std::lround(activity->progress * 100));
        progress_->setValue(percent);
        requested_ = tr("%1 %, asked for by %2").arg(percent).arg(activity->requester);
    }
    progressText_->show(why.isEmpty() ? requested_ : tr("%1; %2").arg(why, requested_));
}

QString CommandCard::whyNotRun() const {
    if (isSending_) return tr("sending");
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const QString problem = fields_[i]->problem();
        if (!problem.isEmpty()) return wrongText(command_.request[i].name, problem);
    }
    if (!whyNot_.isEmpty()) return whyNot_;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const DataItem& item = command_.request[i];
        if (fields_[i]->isEmpty() && !item.hasDefault) {
            return tr("%1 is required").arg(QString::fromStdString(item.name));
        }
    }
    return {};
}

void CommandCard::decide() {
    const QString why = whyNotRun();
    run_->setEnabled(why.isEmpty());
    reason_->show(why);
}

comms::Mirror::Arguments CommandCard::arguments() const {
    comms::Mirror::Arguments result;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        if (auto value = fields_[i]->value()) result[command_.request[i].name] = *value;
    }
    return result;
}

void CommandCard::run() {
    if (!whyNotRun().isEmpty()) return;
    if (command_.confirm)
        ask();
    else
        send();
}

bool CommandCard::takeFocus() {
    QWidget* first = fields_.empty() ? static_cast<QWidget*>(run_) : fields_.front();
    first->setFocus(Qt::TabFocusReason);
    return first->isEnabled();
}

void CommandCard::ask() {
    askToRun(*this, *run_,
             {path_, command_, arguments(), [this] { return owner_; },
              [this] { return whyNotRun(); }, [this] { send(); }});
}

void CommandCard::send() {
    commands_.typed().noteSent(path_, command_.name);
    commands_.send(path_, command_.name, arguments(), command_.isLong ? longLimit : shortLimit,
                   this, [this](const CommandOutcome&) { showOutcomes(); });
    showOutcomes();
}

void CommandCard::cancel() {
    cancel_->setEnabled(false);
    commands_.send(
        path_, "cancel", {}, shortLimit, this, [this](const CommandOutcome&) { showOutcomes(); },
        cancelName());
    showOutcomes();
}

// What became of the last command, and of the last that cancelled it; the newer one first.
void CommandCard::showOutcomes() {
    const Commands::Last* last = commands_.last(path_, command_.name);
    const Commands::Last* cancelled = commands_.last(path_, cancelName());
    const auto which = [](const Commands::Last* one) {
        return one == nullptr ? std::string{}
                              : std::to_string(one->number) + (one->outcome ? "+" : "-");
    };
    std::string all = which(last) + which(cancelled);
    if (all == shown_) return;
    shown_ = std::move(all);
    isSending_ = last != nullptr && !last->outcome && !command_.isLong;
    QStringList answers;
    if (last != nullptr && last->outcome) answers << outcomeText(*last->outcome, &command_);
    if (cancelled != nullptr && cancelled->outcome) {
        const bool newer = last == nullptr || cancelled->number > last->number;
        answers.insert(newer ? 0 : answers.size(),
                       tr("Cancel: %1").arg(outcomeText(*cancelled->outcome)));
    }
    answer_ = answers.join('\n');
    told_->show(QString{answer_}.replace('\n', QStringLiteral("; ")));
    told_->setToolTip(tipText(answer_));
    whole_->setVisible(!answer_.isEmpty());
    decide();
}

// It can be selected, and is scrolled where it is long.
void CommandCard::openAnswer() {
    auto* popover = new Popover{whole_->accessibleName(), this};
    QLabel* text = selectable(answer_);
    text->setMinimumWidth(Look::units(90));
    popover->rows().addWidget(text);
    popover->openBelow(*whole_);
}

void CommandCard::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (enter && event->modifiers().testFlag(Qt::ControlModifier))
        run();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace cortex::gui
