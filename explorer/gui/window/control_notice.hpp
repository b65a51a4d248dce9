// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTimer>
#include <QWidget>
#include <vector>

class QPushButton;

namespace cortex::gui {

class TextLabel;

// What became of a stop or start, and what was refused or lost, in amber, with a remedy. It lies
// over the window, below the bar along the top. There a place of two lines is kept free for it;
// what is longer, and all of it in a low window, lies over what is below. So nothing ever moves
// under the mouse. For a moment after it has come, the mouse still reaches what it lies over.
class ControlNotice : public QWidget {
    Q_OBJECT
public:
    explicit ControlNotice(QWidget* parent = nullptr);

    QWidget& place() { return *place_; }  // that is kept free, in a layout of the window
    // In this window, but not over these buttons at its left edge.
    void lieIn(QWidget& window, std::vector<QWidget*> left);

    void tell(const QString& outcome);                      // of a stop or start
    void show(const QString& text, const QString& remedy);  // empty: nothing, and no button
    QString text() const;
    QPushButton& remedy() { return *remedy_; }

Q_SIGNALS:
    void closed();  // the user has read it

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    bool isEmpty() const;
    void dismiss();
    void appear();
    int keptHeight() const;
    void fit();
    int placeTexts(int width, bool low);

    QWidget* place_;
    std::vector<QWidget*> left_;
    TextLabel *told_, *text_;
    QPushButton *remedy_, *close_;
    QString read_;  // outcome that the user has closed
    QTimer fresh_;
};

}  // namespace cortex::gui
