// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/state_times.hpp"

#include <QWidget>

class QBoxLayout;
class QPushButton;

namespace cortex::gui {

class StateMark;
class TextLabel;

// What is said of a simplex above its tabs: state, since when, fault; path, type and its ancestors;
// agent, age, quality, task time; who writes it; what is amiss with its agent.
class SimplexHeader : public QWidget {
    Q_OBJECT
public:
    // `lifeCycle` stands in it.
    SimplexHeader(QWidget* lifeCycle, const StateTimes& times, QWidget* parent = nullptr);

    void show(const Frame& frame, Place place);  // another simplex, or its structure has changed
    void refresh(const Frame& frame, Place place);
    void setBrief(bool brief) { brief_ = brief; }  // from the next refresh on
    void tell(const QString& outcome);             // what became of a command of the life cycle

Q_SIGNALS:
    void dismissed(const std::string& agent);  // a lost agent may go
    void typeWanted(const std::string& type);  // the user followed the link of an ancestor

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void layOut();
    void fit();
    void placeNames(bool beside);
    void refreshState(const Frame& frame, Place place);
    void refreshFault(const Frame& frame, Place place);
    void refreshAgent(const Frame& frame, Place place);
    void refreshNotice(const Frame& frame, Place place);

    const StateTimes& times_;
    QWidget* lifeCycle_;
    StateMark* mark_;
    TextLabel *state_, *since_, *outcome_, *fault_;
    TextLabel *path_, *type_;
    QWidget* ancestors_;
    TextLabel *agent_, *quality_, *task_;
    TextLabel *description_, *why_, *notice_;
    QPushButton* dismiss_;
    QBoxLayout *title_ = nullptr, *first_ = nullptr, *second_ = nullptr, *rows_ = nullptr,
               *states_ = nullptr;
    std::string agentName_;
    bool brief_ = false;
};

}  // namespace cortex::gui
