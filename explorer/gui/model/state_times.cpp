// SPDX-License-Identifier: Apache-2.0
#include "model/state_times.hpp"

#include "model/shown_time.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <algorithm>
#include <tuple>

namespace cortex::gui {

namespace {

constexpr std::size_t mostChanges = 100'000;

bool isStateChange(const comms::AgentEvent& event) {
    return event.kind == name(EventKind::StateChange) || event.kind == name(EventKind::Fault);
}

QString sinceText(std::int64_t when, double seconds) {
    return QCoreApplication::translate("StateTimes", "since %1, %2")
        .arg(timeAndZone(when, "HH:mm:ss"), wholeAgeText(seconds));
}

}  // namespace

StateTimes::StateTimes() : begin_{QDateTime::currentMSecsSinceEpoch() * 1'000'000} {}

void StateTimes::add(const std::vector<comms::AgentEvent>& events) {
    for (const comms::AgentEvent& each : events) {
        if (!isStateChange(each)) continue;
        const std::pair key{each.agent, each.path};
        if (changes_.size() >= mostChanges && !changes_.contains(key)) continue;
        Change& change = changes_[key];
        const std::tuple known{change.epoch, change.when, change.number};
        if (!(known < std::tuple{each.epoch, each.wallClock, each.number})) continue;
        const bool faults = each.kind == name(EventKind::Fault);
        change = {each.epoch, each.wallClock, each.number, faults ? each.text : std::string{}};
    }
}

const StateTimes::Change* StateTimes::last(const Frame& frame, Place place) const {
    const comms::AgentStatus& agent = frame.agents[place.agent].status;
    const auto found = changes_.find({agent.name, frame.info(place).path});
    const bool known = found != changes_.end() && found->second.epoch == agent.epoch;
    return known ? &found->second : nullptr;
}

std::string StateTimes::fault(const Frame& frame, Place place) const {
    const Change* found = last(frame, place);
    return found != nullptr ? found->fault : std::string{};
}

std::optional<comms::AgentEvent> StateTimes::faultEvent(const Frame& frame, Place place) const {
    const Change* found = last(frame, place);
    if (found == nullptr || found->fault.empty()) return std::nullopt;
    comms::AgentEvent event;
    event.agent = frame.agents[place.agent].status.name;
    event.epoch = found->epoch;
    event.number = found->number;
    event.wallClock = found->when;
    event.severity = Severity::Error;
    event.kind = name(EventKind::Fault);
    event.path = frame.info(place).path;
    event.text = found->fault;
    return event;
}

QString StateTimes::text(const Frame& frame, Place place) const {
    const AgentFrame& agent = frame.agents[place.agent];
    const Change* found = last(frame, place);
    if (found == nullptr) {
        return QCoreApplication::translate("StateTimes", "since before %1")
            .arg(timeAndZone(begin_, "HH:mm"));
    }
    const std::int64_t when = found->when;
    // By the clock of the agent, which also stamped the event.
    const std::int64_t now = agent.image && *agent.image ? (*agent.image)->wallClock() : when;
    const double seconds = static_cast<double>(std::max<std::int64_t>(now - when, 0)) * 1e-9;
    return sinceText(when, seconds);
}

QString StateTimes::longest() const {
    constexpr double minutes = 99 * 60;
    return sinceText(begin_, minutes);
}

}  // namespace cortex::gui
