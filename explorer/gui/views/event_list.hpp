// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QWidget>

namespace cortex::gui {

class EventTable;
class TextLabel;

// The strip below the workspace: the newest events, as the filter of the window leaves them.
class EventList : public QWidget {
    Q_OBJECT
public:
    explicit EventList(EventFilter& events, QWidget* parent = nullptr);

    static QString countOf(const EventFilter& events);  // "441 of 1,652 shown; the oldest 10 are …"

Q_SIGNALS:
    void opened(const std::string& path);

private:
    void tellCount();

    EventFilter& events_;
    EventTable* rows_;
    TextLabel *filter_, *count_;
};

}  // namespace cortex::gui
