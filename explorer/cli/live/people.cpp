// SPDX-License-Identifier: Apache-2.0
#include "live/people.hpp"

#include "common/person_name.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <thread>

namespace cortex::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds betweenLooks{10}, toMeetAll{1000}, toMeetSome{500};

bool areKnown(Live& live, const std::vector<std::string>& names) {
    const auto tools = live.mirror().tools();
    const auto agents = live.mirror().agents();
    return std::ranges::all_of(names, [&](const std::string& each) {
        return each == live.mirror().name() || !common::personOf(tools, each).empty() ||
               std::ranges::find(agents, each, &comms::AgentStatus::name) != agents.end();
    });
}

bool haveMet(Live& live, std::chrono::milliseconds time) {
    return Clock::now() - live.since() >= time && live.mirror().nameless() == 0;
}

void waitABit() {
    throwIfInterrupted();
    std::this_thread::sleep_for(betweenLooks);
}

}  // namespace

void waitForPeople(Live& live) {
    while (!haveMet(live, toMeetAll) && !live.over()) waitABit();
}

void waitForPeople(Live& live, const std::vector<std::string>& names) {
    const auto end = Clock::now() + toMeetSome;
    while (!haveMet(live, toMeetSome) && !areKnown(live, names) && Clock::now() < end) waitABit();
}

std::string personAt(Live& live, const std::string& name) {
    return name == live.mirror().name() ? live.person()
                                        : common::personOf(live.mirror().tools(), name);
}

std::string whoIs(Live& live, const std::string& name) {
    return common::whoText(name, personAt(live, name));
}

std::vector<comms::ShownLease> shownLeases(const Live& live) {
    std::vector<comms::ShownLease> leases;
    for (const comms::AgentStatus& agent : live.mirror().agents()) {
        const auto more = comms::leasesOf(agent, live.mirror().image(agent.name));
        leases.insert(leases.end(), more.begin(), more.end());
    }
    return leases;
}

std::string waitForLeases(Live& live) {
    std::vector<std::string> own;
    for (const comms::AgentStatus& each : live.mirror().agents()) own.push_back("/" + each.name);
    live.view(own, 100);
    const bool complete = live.waitForValues();
    std::string lacking = live.incomplete();
    if (complete || !lacking.empty()) return lacking;
    return "not all agents have sent their leases in time; wait longer (--timeout)";
}

}  // namespace cortex::cli
