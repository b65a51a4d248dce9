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
class EventTable;
class RowNote;
class TextLabel;

// The events of all agents as a view of their own: a filter, chips, all columns, details.
class EventView : public QWidget {
    Q_OBJECT
public:
    EventView(EventFilter& events, const comms::NetworkOptions& network, QWidget* parent = nullptr);

    void refresh();
    void focusFilter();
    void exportTo(const QString& file);  // says what became of it

Q_SIGNALS:
    void opened(const std::string& path);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    QWidget* makeBar();
    void askForFile();
    void search();
    void placeButton();
    void makeRoom();
    void showDetails();

    EventFilter& events_;
    QLineEdit* field_;
    TextLabel *count_, *exported_;
    QPushButton *follow_, *below_;
    EventChips* chips_;
    EventTable* rows_;
    RowNote* trouble_;  // over the last rows
    EventPanel* panel_;
    QLayout* bar_ = nullptr;
    std::optional<std::uint64_t> shown_;  // row of the details, by its serial number
};

}  // namespace cortex::gui
