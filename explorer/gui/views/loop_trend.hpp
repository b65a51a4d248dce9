// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/small_plot.hpp"

#include "model/loop_history.hpp"

#include <QWidget>

class QVBoxLayout;

namespace cortex::gui {

// The duty cycle and the jitter of a loop over the last ten minutes, as far as they were seen.
class LoopTrend : public QWidget {
    Q_OBJECT
public:
    explicit LoopTrend(QWidget* parent = nullptr);
    // `anew`: of another agent or start than before.
    void show(const AgentFrame& agent, const Frame& frame, const LoopHistory& history, bool anew);

private:
    void begin();

    QVBoxLayout* rows_;
    explorer::SmallPlot *duty_ = nullptr, *jitter_ = nullptr;
    double until_ = 0;  // the newest moment that they have
};

}  // namespace cortex::gui
