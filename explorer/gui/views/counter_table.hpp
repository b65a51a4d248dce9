// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/loop_history.hpp"

#include <QTreeWidget>

namespace cortex::gui {

// What an agent counts since its start, and how much of it came in the last minute.
class CounterTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit CounterTable(QWidget* parent = nullptr);
    void show(const AgentFrame& agent, const LoopHistory& history);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }
};

}  // namespace cortex::gui
