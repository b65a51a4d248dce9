// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/quality.hpp"

#include "model/state_times.hpp"
#include "views/message_area.hpp"

#include <QWidget>

class QBoxLayout;
class QPushButton;

namespace cortex::gui {

class StateMark;
class TextLabel;

// What is said of a simplex above its tabs: state, since when; path, type and its ancestors; agent,
// age, quality, task time; then fault, what is amiss with its agent, who writes it. Its height
// follows from the window and from what is shown, never from what comes with time.
class SimplexHeader : public QWidget {
    Q_OBJECT
public:
    // `lifeCycle` stands in it.
    SimplexHeader(QWidget* lifeCycle, const StateTimes& times, QWidget* parent = nullptr);

    void show(const Frame& frame, Place place);  // another simplex, or its structure has changed
    void refresh(const Frame& frame, Place place);
    void setBrief(bool brief) { brief_ = brief; }  // from the next refresh on
    void tell(const QString& outcome);             // what became of a command of the life cycle
    void explain(const QString& reasons) { reasons_ = reasons; }  // why its buttons cannot be used

Q_SIGNALS:
    void dismissed(const std::string& agent);  // a lost agent may go
    void typeWanted(const std::string& type);  // the user followed the link of an ancestor
    void beforeWanted(const comms::AgentEvent& fault);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    struct Room {
        int mark, state, since, buttons, names, facts;  // px, with the gap behind each
    };

    void layOut();
    void fit();
    void placeNames(bool beside);
    void placeState(bool one, bool flat, int left);
    Room room() const;
    void refreshState(const Frame& frame, Place place);
    void showRole(Role role);
    void refreshAgent(const Frame& frame, Place place);
    MessageArea::Message fault(const Frame& frame, Place place);
    MessageArea::Message notice(const Frame& frame, Place place) const;
    bool isTerse() const;
    QString factsOf(const QString& agent, const QString& age) const;
    QString qualityText(Quality quality) const;
    QString restText(bool isData) const;
    QString waitingText() const;

    const StateTimes& times_;
    QWidget* lifeCycle_;
    StateMark* mark_;
    TextLabel *state_, *since_, *outcome_;
    TextLabel *path_, *type_;
    QWidget* ancestors_;
    TextLabel *agent_, *quality_, *task_;
    MessageArea* messages_;
    QPushButton* dismiss_;
    QBoxLayout *title_ = nullptr, *first_ = nullptr, *second_ = nullptr, *rows_ = nullptr,
               *states_ = nullptr;
    QString agentName_, description_, reasons_;
    std::optional<comms::AgentEvent> fault_;  // in which it is, where its event is known
    bool brief_ = false, hasStates_ = false;
    bool hasWord_ = false;  // a state, or what an agent is; data have neither
    int taskWide_ = 0;      // px, the most that its task needed so far
};

}  // namespace cortex::gui
