// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_model.hpp"

#include <QWidget>

class QTreeView;

namespace cortex::explorer {

class TextLabel;

// The events of all agents; it follows the newest unless the user has scrolled up.
class EventList : public QWidget {
    Q_OBJECT
public:
    explicit EventList(EventModel& events, QWidget* parent = nullptr);

Q_SIGNALS:
    void opened(const std::string& path);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void follow();
    void tellCount();

    EventModel& events_;
    QTreeView* rows_;
    TextLabel* count_;
    bool follows_ = true;
};

}  // namespace cortex::explorer
