// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/held_order.hpp"
#include "session/frame.hpp"

#include <QTreeWidget>

namespace cortex::gui {

// Who holds control of which part of an agent. While it is used, the row of one that ends stays.
class LeaseTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit LeaseTable(QWidget* parent = nullptr);
    void show(const Frame& frame, const AgentFrame& agent);
    int count() const { return count_; }

private:
    HeldOrder order_;
    std::string agent_;
    int count_ = 0;
};

}  // namespace cortex::gui
