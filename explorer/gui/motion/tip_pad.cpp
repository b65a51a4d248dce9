// SPDX-License-Identifier: Apache-2.0
#include "motion/tip_pad.hpp"

#include "cortex/explorer/theme.hpp"

#include "motion/jog_button.hpp"

#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QStringList>

namespace cortex::explorer {

namespace {

constexpr double buttonUnits = 11, buttonRise = 9;

struct Place {
    int row, column;
};
// X and Y are a cross, Z stands beside it; of motions 0 to 2, backwards and forwards.
constexpr std::array<std::array<Place, 2>, 3> places{
    {{{{1, 0}, {1, 2}}}, {{{2, 1}, {0, 1}}}, {{{2, 4}, {0, 4}}}}};
constexpr int second = 6, elbowColumn = 12, columns = 14;

struct Key {
    int key, motion, direction;
};
constexpr std::array keys{Key{Qt::Key_Left, 0, -1},     Key{Qt::Key_Right, 0, 1},
                          Key{Qt::Key_Down, 1, -1},     Key{Qt::Key_Up, 1, 1},
                          Key{Qt::Key_PageDown, 2, -1}, Key{Qt::Key_PageUp, 2, 1}};

QString signedName(int motion, int direction) {
    const QString sign = direction > 0 ? QStringLiteral("+") : QString{QChar{0x2212}};
    return (motion == tipElbow ? TipPad::tr("E") : tipMotionName(motion)) + sign;
}

}  // namespace

TipPad::TipPad(QWidget* parent) : QWidget{parent}, masked_{new QLabel} {
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Directions of the tip"));
    addButtons();
    masked_->setWordWrap(true);
    auto* grid = qobject_cast<QGridLayout*>(layout());
    grid->addWidget(masked_, 3, 0, 1, columns + 1);
    fit();
}

void TipPad::addButtons() {
    auto* grid = new QGridLayout{this};
    grid->setColumnStretch(columns, 1);
    for (int motion = 0; motion < tipMotions; ++motion) {
        for (const int direction : {-1, 1}) {
            auto* button = new JogButton{signedName(motion, direction)};
            const QString name = tipMotionName(motion);
            button->setAccessibleName(direction > 0 ? tr("Jog %1 forwards").arg(name)
                                                    : tr("Jog %1 backwards").arg(name));
            connect(button, &QPushButton::pressed, this, [this, motion, direction, button] {
                Q_EMIT pressed(motion, direction, button);
            });
            const std::size_t side = direction > 0 ? 1 : 0;
            const Place place = motion == tipElbow
                                    ? Place{direction > 0 ? 0 : 2, elbowColumn}
                                    : places[static_cast<std::size_t>(motion % 3)][side];
            grid->addWidget(button, place.row,
                            place.column + (turns(motion) && motion != tipElbow ? second : 0));
            buttons_[static_cast<std::size_t>(motion)][side] = button;
        }
    }
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        frames_[i] = new QLabel;
        frames_[i]->setAlignment(Qt::AlignCenter);
        grid->addWidget(frames_[i], 1, 1 + static_cast<int>(i) * second);
    }
}

void TipPad::fit() {
    auto* grid = qobject_cast<QGridLayout*>(layout());
    grid->setContentsMargins(units(4), units(2), units(2), units(2));
    grid->setSpacing(units(0.5));
    for (const int gap : {3, 9}) grid->setColumnMinimumWidth(gap, units(2));
    for (const int gap : {5, 11}) grid->setColumnMinimumWidth(gap, units(3));
    for (const auto& pair : buttons_) {
        for (QPushButton* each : pair) each->setFixedSize(units(buttonUnits), units(buttonRise));
    }
}

void TipPad::make(const std::array<bool, tipMotions>& moves) {
    moves_ = moves;
    QStringList masked;
    for (int motion = 0; motion < tipMotions; ++motion) {
        const bool has = moves[static_cast<std::size_t>(motion)];
        for (const int direction : {-1, 1}) button(motion, direction).setVisible(has);
        if (!has && motion != tipElbow) masked << tipMotionName(motion);
    }
    frames_[0]->setVisible(moves[0] || moves[1]);
    frames_[1]->setVisible(moves[3] || moves[4]);
    masked_->setText(
        masked.isEmpty()
            ? QString{}
            : tr("%1: masked by the item directions").arg(masked.join(QLatin1Char{' '})));
    masked_->setVisible(!masked.isEmpty());
}

void TipPad::show(const QString& frame, const QString& whyNot, int held, int direction) {
    for (QLabel* each : frames_) each->setText(frame);
    for (int motion = 0; motion < tipMotions; ++motion) {
        for (const int side : {-1, 1}) {
            QPushButton& each = button(motion, side);
            each.setDown(held == motion && direction == side);
            if (direction != 0) continue;  // what is held ends with its own reason
            each.setEnabled(whyNot.isEmpty());
            each.setToolTip(whyNot);
        }
    }
}

// A key that repeats itself is held, and begins nothing.
void TipPad::keyPressEvent(QKeyEvent* event) {
    int motion = -1, direction = 0;
    const bool shift = (event->modifiers() & Qt::ShiftModifier) != 0;
    for (const Key& each : keys) {
        if (each.key != event->key()) continue;
        motion = each.motion + (shift ? 3 : 0);
        direction = each.direction;
    }
    if (event->key() == Qt::Key_Plus || event->key() == Qt::Key_Minus) {
        motion = tipElbow;
        direction = event->key() == Qt::Key_Plus ? 1 : -1;
    }
    const auto others = ~(Qt::KeypadModifier | Qt::ShiftModifier);
    const bool moves = motion >= 0 && moves_[static_cast<std::size_t>(motion)];
    if (!moves || (event->modifiers() & others) != 0) {
        QWidget::keyPressEvent(event);
        return;
    }
    if (event->isAutoRepeat()) return;
    setFocus(Qt::OtherFocusReason);  // it may have come from a button
    Q_EMIT pressed(motion, direction, this);
}

void TipPad::paintEvent(QPaintEvent* /*event*/) {
    if (!hasFocus()) return;
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen{palette().color(QPalette::Highlight), 2});
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void TipPad::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    update();
}

void TipPad::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    update();
}

void TipPad::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

}  // namespace cortex::explorer
