// SPDX-License-Identifier: Apache-2.0
#include "drive/axis_band.hpp"

#include "drive/action_row.hpp"
#include "drive/homing_row.hpp"
#include "drive/path_button.hpp"
#include "drive/state_diagram.hpp"
#include "drive/transitions.hpp"
#include "drive/word_table.hpp"
#include "motion/choices.hpp"
#include "motion/labels.hpp"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <algorithm>

namespace cortex::explorer {

namespace {

std::vector<std::pair<QString, QString>> modeChoices(const std::vector<int>& modes) {
    std::vector<std::pair<QString, QString>> choices;
    for (const int each : modes) choices.emplace_back(QString::number(each), modeLetters(each));
    return choices;
}

}  // namespace

AxisBand::AxisBand(const DriveAxis& axis, std::string processor, const std::vector<int>& modes,
                   QWidget* parent)
    : QWidget{parent},
      processor_{std::move(processor)},
      axis_{axis},
      left_{new QWidget},
      right_{new QWidget},
      grid_{new QGridLayout},
      rightRows_{new QVBoxLayout{right_}},
      title_{new QLabel{tr("Axis %1").arg(axis.number)}},
      diagram_{new StateDiagram},
      next_{new Sentence{Tone::Quiet}},
      state_{new Sentence},
      counts_{new Sentence{Tone::Quiet}},
      mode_{new Sentence{Tone::Quiet}},
      why_{new Sentence{Tone::Quiet}},
      told_{new Sentence},
      actions_{new ActionRow},
      modes_{new Choices{modeChoices(modes)}},
      homing_{new HomingRow},
      words_{new WordTable},
      numbers_{new AxisNumbers} {
    head_ = makeHead(axis);
    middle_ = makeControls(modes);
    layOut();
    diagram_->setAccessibleName(tr("States of axis %1").arg(axis.number));
    connectParts();
    arrange(widthOfAll());
    dress();
}

void AxisBand::layOut() {
    auto* leftRows = new QVBoxLayout{left_};
    for (QBoxLayout* each : {static_cast<QBoxLayout*>(leftRows), rightRows_}) {
        each->setContentsMargins(0, 0, 0, 0);
        each->setSpacing(units(1));
    }
    // Each has two lines, whatever it says: no button moves when something comes.
    for (Sentence* each : {next_, counts_, state_, mode_, why_, told_}) {
        each->keepLines(2);
        each->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    }
    leftRows->addWidget(diagram_);
    leftRows->addWidget(next_);
    leftRows->addWidget(counts_);
    leftRows->addStretch(1);
    rightRows_->addWidget(words_);
    rightRows_->addWidget(numbers_);
    rightRows_->addStretch(1);
    grid_->setContentsMargins(units(2), units(1), units(2), units(1));
    grid_->setHorizontalSpacing(units(3));
    grid_->setVerticalSpacing(units(3));
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(head_);
    rows->addLayout(grid_);
}

// Where the values come from and go to; what is not related is said.
QWidget* AxisBand::makeHead(const DriveAxis& axis) {
    auto* head = new QWidget;
    auto* row = new QHBoxLayout{head};
    row->setContentsMargins(units(2), 0, units(2), 0);
    row->setSpacing(units(1.5));
    row->addWidget(title_);
    row->addSpacing(units(4));
    const std::array<std::pair<QString, const std::string*>, 3> all{
        {{tr("drive"), &axis.observation},
         {tr("set-point"), &axis.setpoint},
         {tr("demand"), &axis.demand}}};
    for (const auto& [name, path] : all) {
        auto* label = new QLabel{path->empty() ? tr("no %1 is related").arg(name) : name};
        row->addWidget(label);
        auto* link = new PathButton;
        link->show(QString::fromStdString(*path));
        connect(link, &PathButton::opened, this, &AxisBand::opened);
        row->addWidget(link);
        row->addSpacing(units(3));
    }
    row->addStretch(1);
    return head;
}

QWidget* AxisBand::makeControls(const std::vector<int>& modes) {
    auto* box = new QWidget;
    auto* rows = new QVBoxLayout{box};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(units(0.5));
    for (const int each : modes) {
        modes_->button(QString::number(each))->setAccessibleName(tr("Mode %1").arg(modeText(each)));
    }
    auto* modeRow = new QHBoxLayout;
    modeRow->setSpacing(units(2));
    modeRow->addWidget(new QLabel{tr("Mode")});
    modeRow->addWidget(modes_);
    modeRow->addStretch(1);
    rows->addWidget(state_);
    rows->addWidget(actions_);
    rows->addLayout(modeRow);
    rows->addWidget(mode_);
    rows->addWidget(homing_);
    rows->addWidget(why_);
    rows->addWidget(told_);
    rows->addStretch(1);
    return box;
}

void AxisBand::connectParts() {
    connect(actions_, &ActionRow::wanted, this,
            [this](const QString& command, const QString& title) {
                order(command.toLatin1().constData(), {}, title);
            });
    connect(modes_, &Choices::wanted, this, [this](const QString& mode) {
        order("setMode", {{"mode", mode.toLongLong()}}, tr("Mode %1").arg(modeText(mode.toInt())));
    });
    connect(homing_, &HomingRow::homeWanted, this, [this] { order("home", {}, tr("Home")); });
    connect(homing_, &HomingRow::cancelWanted, this,
            [this] { Q_EMIT ordered({processor_, "cancel", {}}, tr("Cancel")); });
    connect(diagram_, &StateDiagram::wanted, this, [this](int number) {
        const auto word = stepWord(number, axis_.state, axis_.quickStopOption);
        if (word) order("step", {{"word", *word}}, nameOfTransition(number));
    });
}

void AxisBand::order(const char* command, Arguments arguments, const QString& title) {
    arguments.emplace("axis", std::vector<std::int64_t>{axis_.number});
    Q_EMIT ordered({processor_, command, std::move(arguments)}, title);
}

void AxisBand::say(const QString& outcome) { told_->say(outcome); }

// --- layout -----------------------------------------------------------------------------------

int AxisBand::widthOfAll() const {
    const QMargins edges = grid_->contentsMargins();
    return edges.left() + edges.right() + 2 * grid_->horizontalSpacing() +
           left_->minimumSizeHint().width() + middle_->minimumSizeHint().width() +
           std::max(words_->minimumSizeHint().width(), numbers_->minimumSizeHint().width());
}

void AxisBand::arrange(int width) {
    const int beside =
        std::max(words_->minimumSizeHint().width(), numbers_->minimumSizeHint().width()) +
        grid_->horizontalSpacing();
    const int all = widthOfAll();
    const int columns = width >= all ? 3 : width >= all - beside ? 2 : 1;
    if (columns == columns_) return;
    columns_ = columns;
    for (QWidget* each : {left_, middle_, right_}) grid_->removeWidget(each);
    grid_->addWidget(left_, 0, 0);
    grid_->addWidget(middle_, columns > 1 ? 0 : 1, columns > 1 ? 1 : 0);
    if (columns == 3) {
        grid_->addWidget(right_, 0, 2);
    } else {
        grid_->addWidget(right_, columns == 2 ? 1 : 2, 0, 1, columns == 2 ? 2 : 1);
    }
    grid_->setColumnStretch(1, columns > 1 ? 4 : 0);
    grid_->setColumnStretch(2, columns > 2 ? 1 : 0);
    rightRows_->setDirection(columns == 2 ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    rightRows_->setSpacing(units(columns == 2 ? 6 : 1));
}

void AxisBand::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange && event->type() != QEvent::FontChange) return;
    dress();
}

// What stands in a smaller or a larger size.
void AxisBand::dress() {
    QFont large = font();
    large.setPointSizeF(font().pointSizeF() * 1.2);
    large.setWeight(QFont::DemiBold);
    for (QLabel* each : {title_, static_cast<QLabel*>(state_)})
        if (each->font() != large) each->setFont(large);
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.9);
    for (Sentence* each : {next_, counts_, mode_, why_, told_})
        if (each->font() != small) each->setFont(small);
    for (auto* each : modes_->findChildren<QPushButton*>()) each->setFixedHeight(units(7.5));
    middle_->setMaximumWidth(units(122));  // wide buttons are no better; numbers get bars instead
}

void AxisBand::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(head_->geometry(), palette().color(QPalette::AlternateBase));
}

}  // namespace cortex::explorer
