// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QTreeWidget>

namespace cortex::explorer {

// One row for each agent of the domain: where it runs, how it is, what is wrong with it.
class AgentTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit AgentTable(QWidget* parent = nullptr);
    void refresh(const Frame& frame);
};

}  // namespace cortex::explorer
