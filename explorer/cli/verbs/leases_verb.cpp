// SPDX-License-Identifier: Apache-2.0
#include "live/lease_text.hpp"
#include "live/live_values.hpp"
#include "verbs/live_verbs.hpp"

#include <cmath>
#include <iostream>

namespace cortex::cli {
namespace {

std::vector<comms::ShownLease> allLeases(const Live& live) {
    std::vector<comms::ShownLease> leases;
    for (const comms::AgentStatus& agent : live.mirror().agents()) {
        const auto more = comms::leasesOf(agent, live.mirror().image(agent.name));
        leases.insert(leases.end(), more.begin(), more.end());
    }
    return leases;
}

Json leaseJson(const Live& live, const comms::ShownLease& lease) {
    return {{"agent", lease.agent},
            {"prefix", lease.prefix},
            {"holder", lease.holder},
            {"host", hostOf(live.mirror(), lease.holder)},
            {"since", common::utcText(lease.since)},
            {"held_s", lease.seconds},
            {"mine", lease.holder == live.mirror().name()}};
}

void printLeases(const Live& live, const std::vector<comms::ShownLease>& leases) {
    if (leases.empty()) {
        std::cout << "nobody holds control of anything\n";
        return;
    }
    Columns columns{0};
    columns.add({"prefix", "agent", "holder", "host", "since", ""});
    for (const comms::ShownLease& each : leases) {
        columns.add({each.prefix, each.agent, each.holder, hostOf(live.mirror(), each.holder),
                     common::utcText(each.since),
                     each.holder == live.mirror().name() ? "you" : ""});
    }
    columns.print(std::cout);
}

}  // namespace

Exit listLeases(const LiveOptions& options) {
    Live live{options.network};
    live.waitForAll();
    std::vector<std::string> own;
    for (const comms::AgentStatus& each : live.mirror().agents()) own.push_back("/" + each.name);
    live.view(own, 100);
    const bool complete = live.waitForValues();
    const std::string lacking = live.incomplete();
    if (!complete || !lacking.empty()) {
        throw Failure{NotFound, lacking.empty() ? "not all agents have sent their leases in time; "
                                                  "wait longer (--timeout)"
                                                : lacking};
    }
    const auto leases = allLeases(live);
    if (options.json) {
        Json list = Json::array();
        for (const comms::ShownLease& each : leases) list.push_back(leaseJson(live, each));
        print(list);
    } else {
        printLeases(live, leases);
    }
    return Yes;
}

}  // namespace cortex::cli
