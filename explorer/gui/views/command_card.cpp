// SPDX-License-Identifier: Apache-2.0
#include "views/command_card.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "model/shell_text.hpp"
#include "model/value_text.hpp"
#include "widgets/text_label.hpp"
#include "widgets/value_field.hpp"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QGridLayout>
#include <QKeyEvent>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <algorithm>
#include <array>
#include <cmath>

namespace cortex::explorer {

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

QLabel* wrapped() {
    auto* label = new QLabel;
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    return label;
}

}  // namespace

CommandCard::CommandCard(Commands& commands, std::string path, const Command& command,
                         QWidget* parent)
    : QWidget{parent},
      commands_{commands},
      path_{std::move(path)},
      command_{command},
      run_{new QPushButton{tr("Run")}},
      cancel_{new QPushButton{tr("Cancel")}},
      reason_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      progressText_{new TextLabel{TextSize::Text}},
      progress_{new QProgressBar},
      outcome_{wrapped()} {
    const QString name = QString::fromStdString(command_.name);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(Look::units(4), Look::units(2), Look::units(4), Look::units(3));
    auto* title = new TextLabel{TextSize::Text, true};
    title->show(name);
    auto* about = wrapped();
    about->setText(QString::fromStdString(command_.description));
    rows->addWidget(title);
    rows->addWidget(about);

    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(Look::units(3));
    grid->setColumnStretch(3, 1);
    for (const DataItem& each : command_.request) addParameter(*grid, each);
    rows->addLayout(grid);

    auto* last = new QHBoxLayout;
    run_->setAccessibleName(tr("Run %1").arg(name));
    run_->setToolTip(tr("Ctrl+Enter in this form"));
    cancel_->setAccessibleName(tr("Cancel %1").arg(name));
    progress_->setTextVisible(false);
    progress_->setFixedSize(Look::units(40), Look::units(3));
    last->addWidget(run_);
    last->addWidget(reason_);
    last->addWidget(progress_);
    last->addWidget(progressText_);
    last->addWidget(cancel_);
    last->addStretch(1);
    rows->addLayout(last);
    rows->addWidget(outcome_);
    for (QWidget* each :
         std::initializer_list<QWidget*>{outcome_, progress_, progressText_, cancel_}) {
        each->hide();
    }
    connect(run_, &QPushButton::clicked, this, &CommandCard::run);
    connect(cancel_, &QPushButton::clicked, this, [this] {
        commands_.send(path_, "cancel", {}, shortLimit, this, [](const CommandOutcome&) {});
    });
    auto* copy = new QAction{tr("Copy as cortex command"), this};
    connect(copy, &QAction::triggered, this, [this] {
        QApplication::clipboard()->setText(
            shellText(commands_.network(), "call", path_, command_.name, arguments()));
    });
    addAction(copy);
    setContextMenuPolicy(Qt::ActionsContextMenu);
    setAccessibleName(name);
    decide();
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
    connect(field, &ValueField::changed, this, &CommandCard::decide);
}

void CommandCard::refresh(const Frame& frame, Place place) {
    whyNot_ = comms::isControlCommand(command_.name) ? tr("the window does this itself: Ctrl+T")
                                                     : whyNotNow(frame, place, command_.available);
    decide();
    if (!command_.isLong) return;
    const auto activity = activityOf(frame.agents[place.agent], place.simplex);
    const bool runs =
        activity && activity->runs && activity->command == QString::fromStdString(command_.name);
    progress_->setVisible(runs);
    progressText_->setVisible(runs);
    cancel_->setVisible(runs);
    if (!runs) return;
    const int percent = static_cast<int>(std::lround(activity->progress * 100));
    progress_->setValue(percent);
    progressText_->show(tr("%1 %, asked for by %2").arg(percent).arg(activity->requester));
    cancel_->setEnabled(frame.control.covers(frame.agents[place.agent].status.name, path_));
}

QString CommandCard::whyNotRun() const {
    if (isSending_) return tr("sending");
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const QString name = QString::fromStdString(command_.request[i].name);
        const QString problem = fields_[i]->problem();
        if (!problem.isEmpty()) return QStringLiteral("%1 %2").arg(name, problem);
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

// Cancel has the focus, so that Enter does not run it.
void CommandCard::ask() {
    auto* question = new QMessageBox{this};
    question->setAttribute(Qt::WA_DeleteOnClose);
    question->setTextFormat(Qt::PlainText);
    const QString name = QString::fromStdString(command_.name);
    question->setText(tr("%1 on %2?").arg(name, QString::fromStdString(path_)));
    QString details = QString::fromStdString(command_.description);
    for (const auto& [parameter, value] : arguments()) {
        details +=
            QStringLiteral("\n%1 = %2")
                .arg(QString::fromStdString(parameter), QString::fromStdString(toText(value)));
    }
    question->setInformativeText(details);
    auto* yes = question->addButton(tr("Run %1").arg(name), QMessageBox::AcceptRole);
    question->setDefaultButton(question->addButton(QMessageBox::Cancel));
    connect(yes, &QAbstractButton::clicked, this, &CommandCard::send);
    question->open();
}

void CommandCard::send() {
    isSending_ = !command_.isLong;
    decide();
    outcome_->hide();
    commands_.send(path_, command_.name, arguments(), command_.isLong ? longLimit : shortLimit,
                   this, [this](const CommandOutcome& outcome) {
                       isSending_ = false;
                       outcome_->setText(outcomeText(outcome, &command_));
                       outcome_->show();
                       decide();
                   });
}

void CommandCard::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (enter && event->modifiers().testFlag(Qt::ControlModifier))
        run();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace cortex::explorer
