// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/event_model.hpp"

#include <QJsonObject>
#include <QString>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cortex::gui {

// What was in the ten seconds before a fault, of all agents, by the clock of each: what the window
// has of it, and what agents have kept. Each event once, the oldest first, the fault itself last.
class FaultHistory {
public:
    static constexpr std::int64_t length = 10'000'000'000;  // ns
    static constexpr std::size_t most = 2'000;              // rows

    explicit FaultHistory(comms::AgentEvent fault) : fault_{std::move(fault)} {}

    const comms::AgentEvent& fault() const { return fault_; }
    std::int64_t begin() const { return fault_.wallClock - length; }
    // In place of what it had.
    void show(const EventModel& events, std::vector<comms::AgentEvent> kept);
    const std::vector<EventRow>& rows() const { return rows_; }
    std::size_t left() const { return left_; }     // older rows, for which there is no room
    QString secondsOf(const EventRow& row) const;  // "−2.310 s"

    QString title() const;  // "Before the fault of /arm/axis1 at 12:05:07 UTC"
    // What a layout keeps of it.
    QJsonObject saved() const;
    static comms::AgentEvent restored(const QJsonObject& saved);

private:
    bool isOfIt(const comms::AgentEvent& event) const;
    void fold(std::vector<comms::AgentEvent> events);

    comms::AgentEvent fault_;
    std::vector<EventRow> rows_;
    std::size_t left_ = 0;
};

}  // namespace cortex::gui
