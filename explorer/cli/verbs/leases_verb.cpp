// SPDX-License-Identifier: Apache-2.0
#include "common/person_name.hpp"
#include "live/lease_text.hpp"
#include "live/live_values.hpp"
#include "live/people.hpp"
#include "verbs/live_verbs.hpp"

#include <iostream>

namespace cortex::cli {
namespace {

Json leaseJson(Live& live, const comms::ShownLease& lease) {
    return {{"agent", lease.agent},
            {"prefix", lease.prefix},
            {"holder", lease.holder},
            {"person", personAt(live, lease.holder)},
            {"host", hostOf(live.mirror(), lease.holder)},
            {"since", common::utcText(lease.since)},
            {"held_s", lease.seconds},
            {"mine", lease.holder == live.mirror().name()}};
}

void printLeases(Live& live, const std::vector<comms::ShownLease>& leases) {
    if (leases.empty()) {
        std::vector<std::string> heard;  // another one may stand still
        for (const comms::AgentStatus& each : live.mirror().agents()) {
            if (each.state != "lost") heard.push_back(each.name);
        }
        std::cout << "nobody holds control of anything of " << printable(joined(heard)) << '\n';
        return;
    }
    Columns columns{0};
    columns.add({"prefix", "agent", "holder", "person", "host", "since", ""});
    for (const comms::ShownLease& each : leases) {
        const std::string person = personAt(live, each.holder);
        columns.add({each.prefix, each.agent, common::shownName(each.holder),
                     person.empty() ? "-" : common::shownName(person),
                     hostOf(live.mirror(), each.holder), common::utcText(each.since),
                     each.holder == live.mirror().name() ? "you" : ""});
    }
    columns.print(std::cout);
}

}  // namespace

Exit listLeases(const LiveOptions& options) {
    Live live{options.network};
    live.waitForAll();
    const std::string lacking = waitForLeases(live);
    if (!lacking.empty()) throw Failure{NotFound, lacking};
    const auto leases = shownLeases(live);
    std::vector<std::string> holders;
    for (const comms::ShownLease& each : leases) holders.push_back(each.holder);
    waitForPeople(live, holders);
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
