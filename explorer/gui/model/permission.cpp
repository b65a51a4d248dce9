// SPDX-License-Identifier: Apache-2.0
#include "model/permission.hpp"

#include "cortex/core/path.hpp"

#include "common/needed_control.hpp"
#include "model/holders.hpp"
#include "model/shown_time.hpp"
#include "model/value_text.hpp"
#include "session/lease.hpp"

#include <QCoreApplication>
#include <algorithm>

namespace cortex::gui {

namespace {

QString say(const char* text) { return QCoreApplication::translate("Permission", text); }

bool isOfAgent(const Frame& frame, Place place) { return frame.type(place).isA("Agent"); }

std::optional<std::string> neededFor(const Frame& frame, Place place, std::string_view command,
                                     const comms::Mirror::Arguments& arguments) {
    const Command* found = frame.type(place).findCommand(command);
    const DataItem* prefix = nullptr;
    if (found != nullptr) {
        const auto named = std::ranges::find(found->request, "prefix", &DataItem::name);
        if (named != found->request.end()) prefix = &*named;
    }
    return common::neededControl(frame.info(place).path, isOfAgent(frame, place), command, prefix,
                                 arguments);
}

bool onlyStops(const Type& type, std::string_view command) {
    const Command* found = type.findCommand(command);
    return found != nullptr && found->stops;
}

// The part of the plant that control is taken of, where it is lacking.
std::string offered(const Frame& frame, Place place, const std::string& needed) {
    return isOfAgent(frame, place) ? needed : scopeOf(frame, place);
}

QString readOnlyText(const std::string& prefix) {
    return say("read-only: take control of %1").arg(scopeText(prefix));
}

QString whyNotControlled(const Frame& frame, Place place, std::string_view command,
                         const comms::Mirror::Arguments& arguments) {
    const AgentFrame& agent = frame.agents[place.agent];
    const auto needed = neededFor(frame, place, command, arguments);
    if (!needed || frame.control.covers(agent.status.name, *needed)) return {};
    const bool ofAgent = isOfAgent(frame, place);  // it concerns what lies below, too
    for (const comms::ShownLease& lease : leasesOf(agent)) {
        if (lease.holder == frame.control.self) continue;
        if (!isAtOrBelow(*needed, lease.prefix) && !(ofAgent && isAtOrBelow(lease.prefix, *needed)))
            continue;
        return say("held by %1 since %2 (%3)")
            .arg(shortNameOf(frame.control, lease.holder), clockText(lease.since),
                 ageText(lease.seconds));
    }
    if (onlyStops(frame.type(place), command)) return {};
    return readOnlyText(offered(frame, place, *needed));
}

}  // namespace

QString clockText(std::int64_t utc) { return timeAndZone(utc, "HH:mm"); }

QString scopeText(const std::string& prefix) {
    return prefix == "/" ? say("everything") : QString::fromStdString(prefix);
}

std::string scopeOf(const Frame& frame, Place place) {
    if (isOfAgent(frame, place)) return "/";
    const std::string& path = frame.info(place).path;
    return path.substr(0, path.find('/', 1));
}

QString whyWithoutControl(const Frame& frame, Place place) {
    return readOnlyText(scopeOf(frame, place));
}

std::vector<std::string> scopesOf(const Frame& frame) {
    std::vector<std::string> scopes;
    for (const AgentFrame& agent : frame.agents) {
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            const Type& type = *info.layout->type;
            if (info.remote || !type.active() || type.isA("Agent")) continue;
            scopes.push_back(info.path.substr(0, info.path.find('/', 1)));
        }
    }
    std::ranges::sort(scopes);
    scopes.erase(std::unique(scopes.begin(), scopes.end()), scopes.end());
    return scopes;
}

QString whyNotNow(const Frame& frame, Place place, StateSet available, std::string_view command,
                  const comms::Mirror::Arguments& arguments) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (agent.lost()) {
        return say("%1 is not heard").arg(QString::fromStdString(agent.status.name));
    }
    if (available.empty()) return say("never available");
    if (available != StateSet::always()) {
        const auto state = agent.state(place.simplex);
        if (!state) return say("its state has not come yet");
        if (!available.has(*state)) {
            return say("needs %1")
                .arg(QString::fromStdString(available.text()).replace(' ', say(" or ")));
        }
    }
    return whyNotControlled(frame, place, command, arguments);
}

}  // namespace cortex::gui
