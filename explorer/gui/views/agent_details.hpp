// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/loop_history.hpp"
#include "record/recorded_item.hpp"

#include <QElapsedTimer>
#include <QWidget>
#include <cstdint>
#include <string>
#include <vector>

class QPushButton;
class QStackedWidget;
class QVBoxLayout;

namespace cortex::gui {

class AgreementTable;
class CounterTable;
class LeaseTable;
class Link;
class LoopTable;
class LoopTrend;
class TabRow;
class TextLabel;

// All that is known of one agent: what is wrong with it, its loop, who holds control of it, and how
// its types agree with those of others.
class AgentDetails : public QWidget {
    Q_OBJECT
public:
    explicit AgentDetails(QWidget* parent = nullptr);
    void show(const std::string& agent);
    void refresh(const Frame& frame, const LoopHistory& history);
    const std::string& agent() const { return agent_; }
    QString part() const;  // which of "loop", "trend", "leases", "agreement" is in front
    void openPart(const QString& name);
    void takeFocus();

Q_SIGNALS:
    void opened(const std::string& path);
    void plotWanted(const std::vector<RecordedItem>& items);

private:
    QWidget* makeHeader();
    QWidget* makeLoopPage();
    QWidget* makePage(QWidget& table, TextLabel& note);
    void plot();
    void tell(const AgentFrame& agent);
    void refreshPages(const Frame& frame, const AgentFrame& agent);
    void showNothing();

    std::string agent_;
    std::int64_t epoch_ = 0;  // of the start whose loop is shown
    std::string known_;       // how much of it is known
    QElapsedTimer shown_;     // since the digits changed
    TextLabel *name_, *facts_, *troubles_;
    Link* open_;
    QPushButton* plot_;
    TabRow* tabs_;
    QStackedWidget* pages_;
    LoopTable* loop_;
    CounterTable* counters_;
    LoopTrend* trend_;
    LeaseTable* leases_;
    TextLabel* leaseNote_;
    AgreementTable* agreement_;
    TextLabel* agreementNote_;
};

}  // namespace cortex::gui
