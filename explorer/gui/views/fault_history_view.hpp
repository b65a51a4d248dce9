// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_past.hpp"
#include "model/fault_history.hpp"
#include "model/past_reach.hpp"

#include <QJsonObject>
#include <QWidget>
#include <string>
#include <vector>

class QTreeWidget;
class QTreeWidgetItem;

namespace cortex::gui {

class StateMark;
class TextLabel;

// The ten seconds before a fault, of all agents: values that changed their state, changes of state,
// commands with who sent them, refusals, control, losses, limits. It asks all agents once; its rows
// come together, when all have answered, and stay.
class FaultHistoryView : public QWidget {
    Q_OBJECT
public:
    FaultHistoryView(comms::AgentEvent fault, EventPast& past, QWidget* parent = nullptr);

    void refresh(const Frame& frame);
    const FaultHistory& history() const { return history_; }
    bool settled() const { return shown_; }  // all have answered

Q_SIGNALS:
    void opened(const std::string& path);

protected:
    void changeEvent(QEvent* event) override;

private:
    void ask(const Frame& frame);
    void askOne(const std::string& agent, std::int64_t started, bool remembers);
    void take(std::size_t place, comms::PastEvents past);
    void showRows();
    void addRow(const EventRow& row, bool isFault);
    void dress();

    FaultHistory history_;
    EventPast& past_;
    std::vector<PastReach> reach_;  // of whom it asks
    std::vector<comms::AgentEvent> kept_;
    bool asked_ = false, shown_ = false;
    StateMark* mark_;
    TextLabel *title_, *text_, *reachText_;
    QTreeWidget* rows_;
};

}  // namespace cortex::gui
