// SPDX-License-Identifier: Apache-2.0
#include "doctor/doctor.hpp"
#include "doctor/hearing.hpp"
#include "live/loop_text.hpp"
#include "live/pinned_cpus.hpp"
#include "live/top_data.hpp"
#include "text/interrupts.hpp"
#include "text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include <unistd.h>

namespace cortex::cli {
namespace {

using Level = Diagnosis::Level;

constexpr double nearClocks = 0.1;  // s, with what a message takes

std::string hostName() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

// A message of another shape comes from another ontology; otherwise from who knows where.
const char* remedyFor(const std::string& refused) {
    return refused.find(" instead of ") != std::string::npos
               ? "give both agents the same ontology, and start both anew"
               : "look for programs of another version, and for strangers on the network";
}

// As the agent says of who else speaks in its name, if it knows what that one runs.
const char* remedyForName(const std::string& otherSelf) {
    if (otherSelf.find(": the same system") != std::string::npos)
        return "the system runs twice: end the other start, unless it is wanted as a spare "
               "(--wait), which leaves the devices to this one";
    if (otherSelf.find(": another system") != std::string::npos)
        return "give one of the two systems another name: <cluster name=…>";
    return "end the other one; if nobody started it, somebody forges messages: turn security on";
}

void examineState(const comms::AgentStatus& agent, Diagnoses& found) {
    const std::string who = agent.name + " on " + agent.host;
    const auto add = [&](Level level, const std::string& message, const std::string& remedy) {
        found.push_back({level, "agent", message, remedy});
    };
    if (agent.state == "lost") {
        add(Level::Warning, who + " is lost",
            "start it again, or look at the network to " + agent.host);
    } else if (!agent.standstill.empty()) {
        add(Level::Error, "the loop of " + who + " " + agent.standstill,
            "look at that hook, or at what gives the ticks; its values are as old as that");
    } else if (agent.overloaded) {
        add(Level::Error, "the loop of " + who + " " + loopTrouble(agent),
            "look for the task that takes longest ('cortex top'), or state a lower frequency");
    } else if (!agent.trouble.empty()) {
        add(Level::Error, who + " cannot be understood: " + agent.trouble,
            "run the same version of CorteX everywhere");
    } else if (agent.state == "incomplete") {
        add(Level::Error,
            who + " has not sent everything: " + std::to_string(agent.missing) + " of " +
                std::to_string(agent.types + agent.simplexes) + " are missing",
            "look for a firewall or a small MTU between the hosts, or wait longer (--timeout)");
    } else {
        add(Level::Ok, who + ", security " + (agent.security.empty() ? "none" : agent.security),
            "");
    }
    if (!agent.otherSelf.empty()) {
        add(Level::Error, who + " is not alone with its name: " + agent.otherSelf,
            remedyForName(agent.otherSelf));
    }
    if (!agent.dropped.empty()) {
        add(Level::Warning, who + " dropped datagrams: " + printable(agent.dropped),
            "its events say where they came from (cortex events)");
    }
    if (!agent.refused.empty()) {
        const bool hasReason = agent.refused.find(':') != std::string::npos;
        add(Level::Warning,
            who + " refused messages: " + printable(agent.refused) +
                (hasReason ? " (the last reason)" : ""),
            remedyFor(agent.refused));
    }
    if (agent.loss > 0) {
        add(Level::Warning, plural(agent.loss, "message") + " of " + agent.name + " did not come",
            "look at the load of both hosts, cables and buffers");
    }
}

void examineSecurity(const std::vector<comms::AgentStatus>& agents, Diagnoses& found) {
    std::map<std::string, std::vector<std::string>> byState;
    for (const auto& each : agents) byState[each.security].push_back(each.name);
    if (byState.size() < 2) return;
    std::vector<std::string> parts;
    for (const auto& [state, names] : byState) {
        parts.push_back((state.empty() ? "none" : state) + ": " + joined(names));
    }
    found.push_back({Level::Warning, "security", "agents differ: " + joined(parts, "; "),
                     "give each of them a folder of the same authority"});
}

// The agent that was there first says that it hears another start of its name. Nothing more is said
// of those whose state tells it already.
void examineNames(const std::map<std::string, std::set<std::int64_t>>& starts,
                  const std::vector<comms::AgentEvent>& events,
                  const std::vector<comms::AgentStatus>& agents, Diagnoses& found) {
    std::set<std::string> doubled;
    for (const auto& [agent, epochs] : starts) {
        if (epochs.size() > 1) doubled.insert(agent);
    }
    for (const comms::AgentEvent& each : events) {
        if (each.text.starts_with("another start of ")) doubled.insert(each.agent);
    }
    for (const auto& each : agents) {
        if (!each.otherSelf.empty()) doubled.erase(each.name);
    }
    for (const std::string& each : doubled) {
        found.push_back({Level::Error, "name", "several agents are called " + each,
                         "if one system runs twice, end the one that was started later; if they "
                         "are two systems, give one another name: <cluster name=…>"});
    }
}

// How far an agent's time of day is from ours, by the newest image of it. None came: nothing said.
void examineClock(Live& live, const comms::AgentStatus& agent, Diagnoses& found) {
    const comms::AgentImage image = live.mirror().image(agent.name);
    if (!image || image->wallClock() == 0) return;
    const std::uint32_t own = ownSimplex(image->structure());
    const auto age = own == noSimplex ? std::nullopt : live.mirror().age(agent.name, own);
    if (!age || (agent.state != "running" && agent.state != "overloaded")) return;
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const double there = static_cast<double>(image->wallClock()) * 1e-9 + *age;
    const double offset = there - std::chrono::duration<double>(now).count();
    if (std::abs(offset) <= nearClocks) return;
    found.push_back({Level::Warning, "clock",
                     "the time of day of " + agent.name + " on " + agent.host + " is " +
                         std::to_string(std::llround(std::abs(offset) * 1000)) + " ms " +
                         (offset > 0 ? "ahead" : "behind"),
                     "synchronise the clocks of both hosts: sudo apt install chrony"});
}

// Where the loops run, of those that are pinned.
void examineCpus(const Live& live, const comms::AgentStatus& agent, Diagnoses& found) {
    const std::string cpus = pinnedCpus(live, agent.name);
    if (cpus.empty()) return;
    found.push_back(
        {Level::Ok, "agent", "the loop of " + agent.name + " is pinned to CPU " + cpus, ""});
}

}  // namespace

void examineAgents(Live& live, Arrivals& arrivals, Diagnoses& found) {
    std::map<std::string, std::set<std::int64_t>> starts;
    bool complete = false;
    while (!complete && live.left() > std::chrono::milliseconds{1}) {
        throwIfInterrupted();
        const auto slice = std::min(live.left(), std::chrono::milliseconds{100});
        complete = live.mirror().waitUntilComplete(slice);
        for (const auto& each : live.mirror().agents()) starts[each.name].insert(each.epoch);
    }
    const auto agents = live.mirror().agents();
    viewOwnSimplexes(live);
    const std::string closed = closedText(live.mirror().closed());
    if (agents.empty()) {
        const Trouble trouble = live.nobody();
        found.push_back({trouble.isError ? Level::Error : Level::Warning, "agents", trouble.what,
                         trouble.remedy});
    } else if (!closed.empty()) {
        found.push_back(
            {Level::Error, "security", closed + ", and cannot be seen without it", nameAFolder});
    }
    for (const auto& each : live.mirror().agents()) {
        examineState(each, found);
        examineCpus(live, each, found);
        if (each.host != hostName()) examineClock(live, each, found);
    }
    for (const comms::Contested& each : live.mirror().contested()) {
        found.push_back({Level::Error, "owner", each.text,
                         "give one of the simplexes another path in its system file, stop one of "
                         "the agents, or let one of them alone own it with security (cortex "
                         "security create-agent NAME --owns PREFIX)"});
    }
    if (const std::string refused = live.refusedHere(); !refused.empty() && !agents.empty()) {
        found.push_back({Level::Warning, "this tool", printable(refused),
                         "look for programs of another version, and for strangers on the network"});
    }
    examineSecurity(agents, found);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    examineHearing(agents, std::chrono::duration_cast<std::chrono::microseconds>(now).count(),
                   found);
    examineNames(starts, arrivals.take(std::chrono::milliseconds{0}), agents, found);
}

}  // namespace cortex::cli
