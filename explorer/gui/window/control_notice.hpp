// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

class QPushButton;

namespace cortex::gui {

class TextLabel;

// What was refused or lost, in amber, with a remedy. Its height is the same with and without words,
// so that nothing moves under the mouse.
class ControlNotice : public QWidget {
    Q_OBJECT
public:
    explicit ControlNotice(QWidget* parent = nullptr);

    void show(const QString& text, const QString& remedy);  // empty: nothing, and no button
    QString text() const;
    QPushButton& remedy() { return *remedy_; }

Q_SIGNALS:
    void closed();  // the user has read it

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void fit();

    TextLabel* text_;
    QPushButton *remedy_, *close_;
};

}  // namespace cortex::gui
