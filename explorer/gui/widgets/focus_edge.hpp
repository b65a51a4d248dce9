// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPointer>
#include <QWidget>

namespace cortex::gui {

// A property of widgets that want the edge as tables do.
inline constexpr const char* wantsFocusEdge = "wantsFocusEdge";

// An edge around the table, tree or text of its window that has the focus. Fields and buttons draw
// their own.
class FocusEdge : public QWidget {
    Q_OBJECT
public:
    explicit FocusEdge(QWidget* window);
    QWidget* around() const { return around_; }
    void fit();  // to where that stands now: what is above it may have moved it

protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void moveTo(QWidget* focused);

    QPointer<QWidget> around_;
};

}  // namespace cortex::gui
