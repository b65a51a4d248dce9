// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

class QHBoxLayout;
class QPushButton;

namespace cortex::gui {

class TextLabel;

// What became of a stop or start, and what was refused or lost, in amber, with a remedy. Its height
// is the same without words as with two lines, so that nothing moves under the mouse; what is
// longer takes more lines.
class ControlNotice : public QWidget {
    Q_OBJECT
public:
    explicit ControlNotice(QWidget* parent = nullptr);

    void tell(const QString& outcome);                      // of a stop or start
    void show(const QString& text, const QString& remedy);  // empty: nothing, and no button
    QString text() const;
    QPushButton& remedy() { return *remedy_; }

Q_SIGNALS:
    void closed();  // the user has read it

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void fit();

    QHBoxLayout* row_;
    TextLabel *told_, *text_;
    QPushButton *remedy_, *close_;
};

}  // namespace cortex::gui
