// SPDX-License-Identifier: Apache-2.0
#include "model/permission.hpp"

#include "cortex/core/control_commands.hpp"
#include "cortex/core/path.hpp"

#include "model/shown_time.hpp"
#include "model/value_text.hpp"
#include "session/lease.hpp"

#include <QCoreApplication>
#include <algorithm>

namespace cortex::gui {

namespace {

QString say(const char* text) { return QCoreApplication::translate("Permission", text); }

}  // namespace

QString clockText(std::int64_t utc) { return shownTimeText(utc, "HH:mm"); }

QString scopeText(const std::string& prefix) {
    return prefix == "/" ? say("everything") : QString::fromStdString(prefix);
}

std::string scopeOf(const Frame& frame, Place place) {
    if (frame.type(place).isA("Agent")) return "/";
    const std::string& path = frame.info(place).path;
    return path.substr(0, path.find('/', 1));
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

QString whyNotNow(const Frame& frame, Place place, StateSet available, std::string_view command) {
    const AgentFrame& agent = frame.agents[place.agent];
    const std::string& path = frame.info(place).path;
    const bool ofAgent = frame.type(place).isA("Agent");
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
    if (isUrgentCommand(command)) return {};
    // What an agent's own command concerns follows from its prefix, which the agent checks.
    const bool ours = ofAgent ? frame.control.covers(agent.status.name, frame.control.prefix)
                              : frame.control.covers(agent.status.name, path);
    if (ours) return {};
    for (const comms::ShownLease& lease : leasesOf(agent)) {
        if (lease.holder == frame.control.self || !isAtOrBelow(path, lease.prefix)) continue;
        return say("held by %1 since %2 (%3)")
            .arg(QString::fromStdString(lease.holder), clockText(lease.since),
                 ageText(lease.seconds));
    }
    return say("read-only: take control of %1").arg(scopeText(scopeOf(frame, place)));
}

}  // namespace cortex::gui
