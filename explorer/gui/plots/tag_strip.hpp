// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>
#include <QRect>
#include <QWidget>
#include <vector>

class QPainter;

namespace cortex::gui {

// The number of a line, in its colour.
void paintTag(QPainter& painter, const QRect& box, int tag, const QColor& colour);
int tagSize();

// Beside a panel: the number of each line at the height of its newest value. A tag is dragged to
// another panel, which takes the line.
class TagStrip : public QWidget {
    Q_OBJECT
public:
    struct Tag {
        int tag = 0;
        QColor colour;
        double y = 0;
        bool operator==(const Tag&) const = default;
    };
    explicit TagStrip(QWidget* parent = nullptr);
    void show(std::vector<Tag> tags);
    QRect boxOf(int tag) const;  // empty: it is not here

Q_SIGNALS:
    void dragged(int tag, const QPoint& global);  // it is over this place now
    void dropped(int tag, const QPoint& global);
    void givenUp();  // it was taken back to where it was

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

private:
    QRect boxOf(const Tag& tag) const;
    bool isAway(const QPoint& at) const;

    std::vector<Tag> tags_;
    int dragged_ = 0;
    QPoint from_;
};

}  // namespace cortex::gui
