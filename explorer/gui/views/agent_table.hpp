// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/held_order.hpp"
#include "session/frame.hpp"

#include <QTreeWidget>
#include <string>

namespace cortex::gui {

// One row for each agent of the domain: where it runs, how it is, what is wrong with it. While it
// is used, rows keep their places: what comes stands at the end, what goes leaves its name.
class AgentTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit AgentTable(QWidget* parent = nullptr);
    void refresh(const Frame& frame);
    void choose(const std::string& agent);  // its row, as soon as there is one
    int heightOf(int rows) const;

Q_SIGNALS:
    void chosen(const std::string& agent);  // by the user

private:
    void mark();

    HeldOrder order_;
    std::string chosen_;
    bool filling_ = false;  // what changes is not the user's choice
};

}  // namespace cortex::gui
