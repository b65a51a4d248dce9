// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/tip.hpp"

#include <QWidget>
#include <array>

class QLabel;
class QPushButton;

namespace cortex::explorer {

// The buttons that move a tip while they are held: a cross for X and Y with Z beside it, a second
// one for the turns about them, and two for the elbow. One place for the keyboard: ← → ↑ ↓, Page Up
// and Page Down move, with Shift they turn, + and − turn the elbow.
class TipPad : public QWidget {
    Q_OBJECT
public:
    explicit TipPad(QWidget* parent = nullptr);

    void make(const std::array<bool, tipMotions>& moves);  // others have no buttons
    // `whyNot`: none can be pressed; empty: they can. `held`: the motion that runs now, in this
    // direction; 0: none does.
    void show(const QString& frame, const QString& whyNot, int held, int direction);
    QPushButton& button(int motion, int direction) const {
        return *buttons_[static_cast<std::size_t>(motion)][direction > 0 ? 1 : 0];
    }

Q_SIGNALS:
    void pressed(int motion, int direction, QWidget* held);  // of a button, or of a key

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void addButtons();
    void fit();

    std::array<std::array<QPushButton*, 2>, tipMotions> buttons_{};
    std::array<bool, tipMotions> moves_{};
    QLabel* masked_;
    std::array<QLabel*, 2> frames_{};  // in the middle of each cross
};

}  // namespace cortex::explorer
