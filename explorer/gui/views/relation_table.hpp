// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QStringList>
#include <QTreeWidget>
#include <string>
#include <vector>

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
    struct Row {
        bool outgoing;
        QStringList texts;  // without the state
        QString tip;
        Place other;
    };
    static Row rowOf(const Frame& frame, const Edge& edge, Place other, bool outgoing);
    static std::vector<Row> rowsOf(const Frame& frame, Place place);
    void fill(const std::vector<Row>& rows);

    std::string path_;
    std::vector<QTreeWidgetItem*> items_;  // of the rows, in their order
    int count_ = 0;
};

}  // namespace cortex::gui
