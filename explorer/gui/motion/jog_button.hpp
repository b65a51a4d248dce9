// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPushButton>

namespace cortex::explorer {

// A button that jogs while it is held. It leaves the arrow keys to what it stands in, where they
// jog, and do not go from button to button. A press counts once: a pointer that comes back while
// the mouse is down presses nothing anew.
class JogButton : public QPushButton {
    Q_OBJECT
public:
    explicit JogButton(const QString& text, QWidget* parent = nullptr);

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void dress();

    bool dressing_ = false;
};

}  // namespace cortex::explorer
