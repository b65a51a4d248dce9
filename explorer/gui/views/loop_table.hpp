// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/loop_metrics.hpp"

#include <QTreeWidget>

namespace cortex::gui {

// What the loop of an agent measures: the duty cycle as a bar with a line at 100 %, and times as
// marks of their percentiles on one logarithmic axis, each with its numbers.
class LoopTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit LoopTable(QWidget* parent = nullptr);
    void show(const LoopMetrics& metrics, bool anew);  // `anew`: of another agent or start

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    class Delegate;
    void fill(QTreeWidgetItem& row, const LoopFigure& figure);
    void fitChart();

    LoopMetrics metrics_;
    LogAxis axis_;
};

}  // namespace cortex::gui
