// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QTimer>
#include <QWidget>

class QPushButton;

namespace cortex::gui {

class EventTable;
class TextLabel;

// The strip below the workspace: the newest events, as the filter of the window leaves them. It
// says how many faults and errors the filter hides. It follows the newest unless somebody has
// scrolled up, and again when pointer and keyboard have been elsewhere for some seconds.
class EventList : public QWidget {
    Q_OBJECT
public:
    explicit EventList(EventFilter& events, QWidget* parent = nullptr);

    static QString countOf(const EventFilter& events);  // "441 of 1,652 shown; 10 older ones are …"
    // "2 faults or errors not shown"; empty: all are.
    static QString hiddenIn(const EventFilter& events);

Q_SIGNALS:
    void opened(const std::string& path);
    void beforeWanted(const comms::AgentEvent& fault);

protected:
    void changeEvent(QEvent* event) override;

private:
    QWidget* makeHead();
    void fit();
    void tellCount();
    void tellNew();
    void tellBefore();
    void lookWhetherLeft();

    EventFilter& events_;
    EventTable* rows_;
    TextLabel *title_, *filter_, *hidden_, *count_;
    QPushButton *before_, *showAll_, *new_;
    QWidget* head_;
    QTimer left_{this};  // while it does not follow
    int away_ = 0;       // times of left_ at which nobody was in it
};

}  // namespace cortex::gui
