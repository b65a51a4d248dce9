// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/loop_history.hpp"
#include "record/recorded_item.hpp"

#include <QJsonObject>
#include <QWidget>
#include <string>
#include <vector>

namespace cortex::gui {

class AgentDetails;
class AgentTable;

// All agents as rows, and below them all that is known of the one that is chosen.
class AgentView : public QWidget {
    Q_OBJECT
public:
    explicit AgentView(QWidget* parent = nullptr);
    void refresh(const Frame& frame);
    void choose(const std::string& agent);

    QJsonObject saved() const;
    void restore(const QJsonObject& saved);

Q_SIGNALS:
    void opened(const std::string& path);
    void plotWanted(const std::vector<RecordedItem>& items);

private:
    void fitTable();

    LoopHistory history_;
    AgentTable* table_;
    AgentDetails* details_;
    int rows_ = 0;  // of the table, for which there is room
};

}  // namespace cortex::gui
