// SPDX-License-Identifier: Apache-2.0
#include "live/lease_text.hpp"

#include "live/live_values.hpp"
#include "live/people.hpp"

#include <cmath>

namespace cortex::cli {
namespace {

std::string durationText(double seconds) {
    const auto whole = std::llround(seconds);
    if (whole < 120) return std::to_string(whole) + " s";
    if (whole < 7200) return std::to_string(whole / 60) + " min";
    return std::to_string(whole / 3600) + " h";
}

}  // namespace

// A tool has its host in its name, tool@host.process; an agent says its own.
std::string hostOf(const comms::Mirror& mirror, const std::string& holder) {
    for (const comms::AgentStatus& each : mirror.agents()) {
        if (each.name == holder) return each.host;
    }
    const std::size_t at = holder.find('@'), dot = holder.rfind('.');
    if (at == std::string::npos || dot == std::string::npos || dot < at) return "";
    return holder.substr(at + 1, dot - at - 1);
}

std::string holderText(Live& live, const comms::ShownLease& lease) {
    const std::string host = hostOf(live.mirror(), lease.holder);
    return whoIs(live, lease.holder) + (host.empty() ? "" : " on host " + host) + " holds " +
           lease.prefix + " of agent " + lease.agent + " since " + common::utcText(lease.since) +
           " (" + durationText(lease.seconds) + ")";
}

}  // namespace cortex::cli
