// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plots/plot_range.hpp"

#include <QWidget>

namespace cortex::gui {

// The one time axis of all panels, in the zone that is shown, which it names. Before anything has
// come there are no times.
class TimeAxis : public QWidget {
    Q_OBJECT
public:
    explicit TimeAxis(QWidget* parent = nullptr);
    void show(TimeSpan span, int left, int right);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    TimeSpan span_;
    int left_ = 0, right_ = 0;
};

}  // namespace cortex::gui
