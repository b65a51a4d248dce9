// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QTreeWidget>

namespace cortex::gui {

// Who holds control of which part of an agent.
class LeaseTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit LeaseTable(QWidget* parent = nullptr);
    void show(const Frame& frame, const AgentFrame& agent);
    int count() const { return topLevelItemCount(); }
};

}  // namespace cortex::gui
