// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"
#include "model/last_events.hpp"
#include "model/state_times.hpp"

#include <QScrollArea>
#include <QWidget>
#include <array>
#include <memory>
#include <optional>
#include <string>

class QGridLayout;
class QHBoxLayout;
class QStackedWidget;

namespace cortex::gui {

class EmptyPage;
class Link;
class OverviewPart;
class TextLabel;

// The first page: agents, what is wrong, who controls what, and what happened last; each row opens
// its place. In two columns, or in one that scrolls where there is little room.
class OverviewView : public QWidget {
    Q_OBJECT
public:
    OverviewView(const Abnormal& abnormal, const StateTimes& times, const EventModel& events,
                 QWidget* parent = nullptr);
    void refresh(const std::shared_ptr<const Frame>& frame);
    void openAt(const OverviewRow& row);  // its simplex

Q_SIGNALS:
    void opened(const std::string& path);
    void itemOpened(const std::string& path, const std::string& item);
    void agentOpened(const std::string& name);  // empty: all agents
    void eventOpened(const OverviewRow& row);   // by its key
    void eventsOpened();

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    enum Part { Agents, Wrong, InControl, Last, PartCount };
    QWidget* makeContent();
    void showParts(const Frame& frame);
    void tellOfRest(const Frame& frame, bool held);
    void arrange();

    const Abnormal& abnormal_;
    const StateTimes& times_;
    LastEvents last_;
    std::shared_ptr<const Frame> frame_;
    std::uint64_t looked_ = 0;
    std::optional<bool> wide_;  // it has two columns
    bool local_ = false;        // times are shown in the zone of this computer
    QStackedWidget* whole_;
    EmptyPage* empty_;
    QScrollArea* area_;
    TextLabel* intro_;
    Link* allEvents_;
    TextLabel* note_;
    std::array<OverviewPart*, PartCount> parts_;
    QHBoxLayout* introRow_;
    QGridLayout* grid_;
};

}  // namespace cortex::gui
