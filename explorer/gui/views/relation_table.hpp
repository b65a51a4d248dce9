// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QTreeWidget>
#include <string>

namespace cortex::gui {

// The relationships of a simplex, and those of others to it, also of simplexes of other agents.
class RelationTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit RelationTable(QWidget* parent = nullptr);

    void show(const Frame& frame, Place place);
    void refresh(const Frame& frame);     // states and qualities at the other ends
    int count() const { return count_; }  // of all

Q_SIGNALS:
    void opened(const std::string& path);

private:
    void add(QTreeWidgetItem* group, const Frame& frame, const Edge& edge, Place other);
    void showOthers(const Frame& frame, Place place);

    int count_ = 0;
};

}  // namespace cortex::gui
