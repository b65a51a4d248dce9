// SPDX-License-Identifier: Apache-2.0
// What a mirror knows of one agent.
#include "cortex/core/error.hpp"

#include "mirror/mirror_agents.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"
#include "wire/simplex_marks.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cortex::comms {
namespace {

constexpr std::uint16_t major = 1;
constexpr std::size_t longestReason = 200;
constexpr std::uint64_t mostHeard = 1'000'000;

}  // namespace

bool MirrorAgent::foreign() const {
    return present() && std::ranges::count(model.presence()->majors, major) == 0;
}

bool MirrorAgent::holdsName(Moment now) const {
    return !lost && present() &&
           now - heard <= std::chrono::nanoseconds{patienceWithRival(*model.presence())};
}

// After it said goodbye, or somebody in its name.
bool MirrorAgent::isGone(Moment now) const {
    const auto patience = present() ? patienceAfterGoodbye(*model.presence()) : shortestInterval;
    return now - heard > std::chrono::nanoseconds{patience};
}

std::chrono::nanoseconds MirrorAgent::patience() const {
    return std::chrono::nanoseconds{present() ? patienceWith(*model.presence()) : shortestPatience};
}

AgentImage MirrorAgent::image() const {
    if (!tables || (!viewed && !lost)) return {};
    return {tables, tables->newest(), tables->received(), lost, tables->behind()};
}

bool MirrorAgent::summarises() const {
    return present() && numberIn(*model.presence(), summaries) != 0;
}

bool MirrorAgent::remembers() const {
    return present() && numberIn(*model.presence(), ofThePast) != 0;
}

// Of one that cannot say so itself, as its image says.
std::vector<SimplexMark> MirrorAgent::marks(Moment now) const {
    if (!structure) return {};
    const std::size_t count = structure->simplexes.size();
    if (summarises()) {
        return summary.marks(*structure, lost, model.presence()->period, now);
    }
    const AgentImage shown = image();
    std::vector<SimplexMark> marks;
    if (!shown) return marks;
    const SimplexMarks looks{*structure};
    for (std::uint32_t i = 0; i < count; ++i) {
        marks.push_back(shown.came(i) ? looks.of(i, shown->slice(i)) : SimplexMark{});
    }
    return marks;
}

CommandTarget MirrorAgent::target() {
    if (!structure) throw Error("agent " + model.agent() + " has not sent its structure yet");
    if (!commands) commands = std::make_shared<CommandTables>(structure);
    return {model, *commands, cycle, heard, clock, clockHeard, lost};
}

// As of the last presence, and the time since then.
std::string MirrorAgent::standstillText(Moment now) const {
    const std::string why = present() && !lost ? textIn(*model.presence(), standstill) : "";
    if (why.empty()) return {};
    const std::int64_t stood = timeIn(*model.presence(), timeStood);
    const double seconds =
        static_cast<double>(stood) * 1e-9 + std::chrono::duration<double>(now - clockHeard).count();
    return why.substr(0, longestReason) + " for " + toText(std::round(seconds * 10) / 10) + " s";
}

AgentStatus MirrorAgent::status(Moment now) const {
    AgentStatus status;
    status.name = model.agent();
    status.epoch = model.epoch();
    status.ended = lost && !missed;
    status.since = since.time_since_epoch().count();
    status.age = std::chrono::duration<double>(now - moved).count();
    status.missing = model.missing();
    status.missingTypes = model.missingTypes();
    status.missingNames = model.missingNames();
    status.cycle = cycle;
    status.loss = eventLoss + (tables ? tables->loss() : 0);
    if (present()) {
        const Presence& presence = *model.presence();
        status.host = presence.host;
        status.state = presence.state;
        status.types = presence.types;
        status.simplexes = presence.simplexes;
        status.period = presence.period;
        status.security = presence.security;
        status.rate = static_cast<double>(numberIn(presence, rateOfLoop)) * 1e-3;
        status.overloaded = !lost && numberIn(presence, overloaded) != 0;
        status.dropped = textIn(presence, droppedDatagrams);
        status.hears = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(numberIn(presence, agentsHeard), mostHeard));
        status.summarises = summarises();
        status.remembers = remembers();
        status.refused = textIn(presence, refusedMessages);
        status.otherSelf = textIn(presence, otherSelf).substr(0, longestReason);
    }
    if (foreign()) {
        status.trouble = "it speaks none of the protocols that this program knows";
    } else if (!model.findings().ok()) {
        status.trouble = model.findings().findings.front().text();
    }
    status.standstill = standstillText(now);
    const bool whole = present() && !foreign() && model.complete() && status.trouble.empty();
    if (status.overloaded) status.state = "overloaded";
    if (!status.standstill.empty()) status.state = "standstill";
    if (!whole) status.state = "incomplete";
    if (lost) status.state = "lost";
    return status;
}

}  // namespace cortex::comms
