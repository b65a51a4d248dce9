// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_filter.hpp"

#include <QWidget>
#include <optional>
#include <string>

class QLayout;
class QLineEdit;
class QPushButton;

namespace cortex::gui {

class EventChips;
class EventPanel;
class EventPast;
class EventTable;
class RowNote;
class TextLabel;

// The events of all agents as a view of their own: a filter, how far back agents are asked for what
// they keep, chips, all columns, details.
class EventView : public QWidget {
    Q_OBJECT
public:
    // `past`: null where nobody is asked.
    EventView(EventFilter& events, const comms::NetworkOptions& network, EventPast* past = nullptr,
              QWidget* parent = nullptr);

    void refresh();
    void focusFilter();
    void choose(std::uint64_t serial);   // with its details, and the keyboard is there
    void exportTo(const QString& file);  // says what became of it

Q_SIGNALS:
    void opened(const std::string& path);
    void beforeWanted(const comms::AgentEvent& fault);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    QWidget* makeBar();
    void makeBack();
    void fitBack();
    void tellPast();
    void askForFile();
    void search();
    void placeButton();
    void makeRoom();
    void showDetails();

    EventFilter& events_;
    EventPast* past_;
    QLineEdit* field_;
    TextLabel *count_, *exported_, *reach_;
    QPushButton *back_, *follow_, *below_;
    EventChips* chips_;
    EventTable* rows_;
    RowNote* trouble_;  // over the last rows
    EventPanel* panel_;
    QLayout* bar_ = nullptr;
    std::optional<std::uint64_t> shown_;  // row of the details, by its serial number
};

}  // namespace cortex::gui
