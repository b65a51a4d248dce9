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
      stateBox_{new QWidget},
      grid_{new QGridLayout},
      headRow_{new QHBoxLayout},
      middleRows_{new QVBoxLayout},
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
    // Each has its lines, whatever it says: no button moves when something comes.
    for (Sentence* each : {next_, why_}) {
        each->keepLines(2);
        each->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    }
    mode_->keepLines(1);
    counts_->keepLines(1);
    counts_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    auto* stateRows = new QVBoxLayout{stateBox_};
    stateRows->setContentsMargins(0, 0, 0, 0);
    stateRows->setSpacing(0);
    stateRows->addWidget(state_);
    stateRows->addWidget(counts_);
    stateRows->addStretch(1);
    leftRows->addWidget(diagram_);
    leftRows->addWidget(next_);
    leftRows->addStretch(1);
    rightRows_->addWidget(words_);
    rightRows_->addWidget(numbers_);
    rightRows_->addStretch(1);
    grid_->setContentsMargins(units(2), units(0.5), units(2), 0);
    grid_->setHorizontalSpacing(units(3));
    grid_->setVerticalSpacing(units(3));
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(head_);
    rows->addLayout(grid_);
}

// Where the values come from and go to; what is not related is said. At its end is room for what
// came of an order.
QWidget* AxisBand::makeHead(const DriveAxis& axis) {
    auto* head = new QWidget;
    head->setLayout(headRow_);
    headRow_->setContentsMargins(units(2), 0, units(2), 0);
    headRow_->setSpacing(units(1.5));
    headRow_->addWidget(title_);
    headRow_->addSpacing(units(4));
    const std::array<std::pair<QString, const std::string*>, 3> all{
        {{tr("drive"), &axis.observation},
         {tr("set-point"), &axis.setpoint},
         {tr("demand"), &axis.demand}}};
    for (const auto& [name, path] : all) {
        auto* label = new QLabel{path->empty() ? tr("no %1 is related").arg(name) : name};
        headRow_->addWidget(label);
        auto* link = new PathButton;
        link->show(QString::fromStdString(*path));
        connect(link, &PathButton::opened, this, &AxisBand::opened);
        headRow_->addWidget(link);
        headRow_->addSpacing(units(3));
    }
    headRow_->addStretch();
    return head;
}

QWidget* AxisBand::makeControls(const std::vector<int>& modes) {
    auto* box = new QWidget;
    box->setLayout(middleRows_);
    middleRows_->setContentsMargins(0, 0, 0, 0);
    middleRows_->setSpacing(units(0.25));
    for (const int each : modes) {
        modes_->button(QString::number(each))->setAccessibleName(tr("Mode %1").arg(modeText(each)));
    }
    auto* modeRow = new QHBoxLayout;
    modeRow->setSpacing(units(2));
    modeRow->addWidget(new QLabel{tr("Mode")});
    modeRow->addWidget(modes_);
    modeRow->addStretch(1);
    middleRows_->addWidget(stateBox_);
    middleRows_->addWidget(actions_);
    middleRows_->addLayout(modeRow);
    middleRows_->addWidget(mode_);
    middleRows_->addWidget(homing_);
    middleRows_->addWidget(why_);
    middleRows_->addStretch(1);
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
    placeAnswer();
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
    rightRows_->setSpacing(columns == 2 ? units(6) : 0);
}

// What came of an order: in the head where that has room, otherwise below the buttons.
void AxisBand::placeAnswer() {
    const bool inHead = columns_ == 3;
    QBoxLayout* place = inHead ? headRow_ : middleRows_;
    if (place->indexOf(told_) < 0) place->insertWidget(place->count() - 1, told_, inHead ? 1 : 0);
    told_->keepLines(inHead ? 1 : 2);
    told_->setMinimumWidth(inHead ? units(60) : 0);
    told_->setAlignment(Qt::AlignLeft | (inHead ? Qt::AlignVCenter : Qt::AlignTop));
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
    stateBox_->setFixedHeight(2 * QFontMetrics{large}.lineSpacing());
    for (auto* each : modes_->findChildren<QPushButton*>()) each->setFixedHeight(units(7.5));
    middle_->setMaximumWidth(units(122));  // wide buttons are no better; numbers get bars instead
}

void AxisBand::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(head_->geometry(), palette().color(QPalette::AlternateBase));
}

}  // namespace cortex::explorer
