// SPDX-License-Identifier: Apache-2.0
#include "model/state_times.hpp"

#include "model/shown_time.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr std::size_t mostChanges = 100'000;

bool isStateChange(const comms::AgentEvent& event) {
    return event.kind == name(EventKind::StateChange) || event.kind == name(EventKind::Fault);
}

}  // namespace

StateTimes::StateTimes() : begin_{QDateTime::currentMSecsSinceEpoch() * 1'000'000} {}

void StateTimes::add(const std::vector<comms::AgentEvent>& events) {
    for (const comms::AgentEvent& each : events) {
        if (!isStateChange(each)) continue;
        const std::pair key{each.agent, each.path};
        if (changes_.size() >= mostChanges && !changes_.contains(key)) continue;
        Change& change = changes_[key];
        const std::pair known{change.epoch, change.when}, told{each.epoch, each.wallClock};
        if (known < told) change = {each.epoch, each.wallClock};
    }
}

QString StateTimes::text(const Frame& frame, Place place) const {
    const AgentFrame& agent = frame.agents[place.agent];
    const auto found = changes_.find({agent.status.name, frame.info(place).path});
    if (found == changes_.end() || found->second.epoch != agent.status.epoch) {
        return QCoreApplication::translate("StateTimes", "since before %1")
            .arg(shownTimeText(begin_, "HH:mm"));
    }
    const std::int64_t when = found->second.when;
    // By the clock of the agent, which also stamped the event.
    const std::int64_t now = agent.image && *agent.image ? (*agent.image)->wallClock() : when;
    const double seconds = static_cast<double>(std::max<std::int64_t>(now - when, 0)) * 1e-9;
    return QCoreApplication::translate("StateTimes", "since %1, %2")
        .arg(shownTimeText(when, "HH:mm:ss"), wholeAgeText(seconds));
}

}  // namespace cortex::gui
