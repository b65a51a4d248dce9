// SPDX-License-Identifier: Apache-2.0
#include "motion/jog_button.hpp"

#include "cortex/explorer/theme.hpp"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <array>

namespace cortex::explorer {

namespace {

constexpr double manyLetters = 3.5, oneSign = 4.5;  // units high
constexpr std::array movingKeys{Qt::Key_Left, Qt::Key_Right,  Qt::Key_Up,
                                Qt::Key_Down, Qt::Key_PageUp, Qt::Key_PageDown};

}  // namespace

JogButton::JogButton(const QString& text, QWidget* parent) : QPushButton{text, parent} {
    setFocusPolicy(Qt::ClickFocus);  // what it stands in is one place for the keyboard
    dress();
}

// Enter presses nothing here: a jog is held.
void JogButton::keyPressEvent(QKeyEvent* event) {
    if (std::ranges::find(movingKeys, event->key()) != movingKeys.end())
        event->ignore();
    else if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter)
        QPushButton::keyPressEvent(event);
}

void JogButton::mouseMoveEvent(QMouseEvent* event) { event->accept(); }

void JogButton::changeEvent(QEvent* event) {
    QPushButton::changeEvent(event);
    const QEvent::Type type = event->type();
    if (type == QEvent::StyleChange || type == QEvent::ApplicationFontChange) dress();
}

// A thin stroke would be pale. The size goes with that of the button.
void JogButton::dress() {
    if (dressing_) return;
    dressing_ = true;
    QFont strong = QApplication::font();
    const int pixels = units(text().size() > 1 ? manyLetters : oneSign);
    strong.setPointSizeF(pixels * 72.0 / logicalDpiY());
    strong.setWeight(QFont::Bold);
    setFont(strong);
    dressing_ = false;
}

}  // namespace cortex::explorer
