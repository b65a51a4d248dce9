// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QLineEdit>
#include <QPointer>
#include <QWidget>

namespace cortex::gui {

// What is wrong with what is being entered, just below its field or, at the lower end, above it. It
// lies over what is there, so that nothing moves, and goes with the field.
class EntryHint : public QWidget {
    Q_OBJECT
public:
    explicit EntryHint(QLineEdit& field);  // beside it, in the same parent

    void say(const QString& why);  // empty: nothing is wrong
    const QString& text() const { return text_; }

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void place();

    QPointer<QWidget> field_;  // it still gets events when it is no QLineEdit any more
    QString text_;
};

}  // namespace cortex::gui
