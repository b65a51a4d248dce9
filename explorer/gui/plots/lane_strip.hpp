// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/lanes.hpp"

#include <QColor>
#include <QWidget>

namespace cortex::gui {

// Lines of words below the panels: labels, states, truths and texts.
class LaneStrip : public QWidget {
    Q_OBJECT
public:
    explicit LaneStrip(QWidget* parent = nullptr);

    void show(std::vector<DrawnLine> lanes, const Recorder& recorder, TimeSpan span);
    void setEdges(int left, int right);  // of all canvases, in pixels
    std::vector<LaneWord> words(int lane) const;
    QColor colourOf(int lane, const LaneWord& word) const;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void paintLane(QPainter& painter, const QRect& row, int lane) const;

    std::vector<DrawnLine> lanes_;
    std::vector<std::vector<LaneWord>> words_;
    TimeSpan span_;
    int left_ = 0, right_ = 0;
};

}  // namespace cortex::gui
