// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QFrame>
#include <QRect>

class QHBoxLayout;
class QVBoxLayout;

namespace cortex::gui {

class TextLabel;

// A small window with a title that a click beside it, or Esc, closes. It deletes itself then. It
// lies inside of the screen, also when its content grows while it is open.
class Popover : public QFrame {
    Q_OBJECT
public:
    explicit Popover(const QString& title, QWidget* parent = nullptr);

    QVBoxLayout& rows() { return *rows_; }        // they scroll where the screen is too small
    QHBoxLayout& buttons() { return *buttons_; }  // below the rows, at the right; always in sight
    // Below the anchor, else above it; moved to the left where its window or the screen ends.
    void openBelow(const QWidget& anchor);
    void openAmid(const QWidget& window);

Q_SIGNALS:
    void closed();  // by whatever a person did

protected:
    TextLabel& title() { return *title_; }
    bool event(QEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;  // Enter presses the button with the keyboard
    void paintEvent(QPaintEvent* event) override;

private:
    void lieOnScreenOf(const QWidget& widget);
    void fit();
    void moveInside(QPoint corner);

    TextLabel* title_;
    QVBoxLayout* rows_;
    QHBoxLayout* buttons_;
    QRect screen_;  // where it may lie
};

}  // namespace cortex::gui
