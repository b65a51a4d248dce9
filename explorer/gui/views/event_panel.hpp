// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_row.hpp"

#include <QWidget>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

class QPushButton;

namespace cortex::gui {

class StateMark;
class TextLabel;

// The details of the row that is selected. A row that drops out leaves them, with the words `no
// longer kept`; one that a filter hides does not. Its height is the same for every event, and
// before there is one.
class EventPanel : public QWidget {
    Q_OBJECT
public:
    explicit EventPanel(comms::NetworkOptions network, QWidget* parent = nullptr);

    void show(const EventRow& row, std::uint64_t serial);  // its number among all rows
    void clear();
    void sayDropped();
    void setCompact(bool compact);  // the text alone, where there is little room

Q_SIGNALS:
    void opened(const std::string& path);
    void beforeWanted(const comms::AgentEvent& fault);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void addPairs();
    void fill(const EventRow& row);

    const comms::NetworkOptions network_;
    comms::AgentEvent event_;
    std::optional<std::uint64_t> serial_;  // of what is shown
    std::uint64_t times_ = 0;
    StateMark* mark_;
    TextLabel *title_, *dropped_, *command_;
    QPushButton *before_, *open_;
    QWidget* more_;                                              // all but the text
    std::array<std::pair<TextLabel*, TextLabel*>, 12> pairs_{};  // name and text
};

}  // namespace cortex::gui
