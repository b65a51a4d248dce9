// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/drawn_line.hpp"

#include <QWidget>

namespace cortex::gui {

// Everything that is kept of one line, with a window around what is shown. The window is dragged.
class OverviewStrip : public QWidget {
    Q_OBJECT
public:
    explicit OverviewStrip(QWidget* parent = nullptr);
    void show(const DrawnLine& line, TimeSpan kept, TimeSpan shown);
    void setEdges(int left, int right);

Q_SIGNALS:
    void moved(double to);  // the end of what is shown, s

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;

private:
    double secondsAt(int x) const;
    QString lengthText(int room) const;
    void paintLine(QPainter& painter, const QRect& box) const;

    DrawnLine line_;
    TimeSpan kept_, shown_;
    int left_ = 0, right_ = 0;
    double grip_ = 0;  // from the pointer to the end of the window, s
};

}  // namespace cortex::gui
