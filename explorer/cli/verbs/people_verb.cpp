// SPDX-License-Identifier: Apache-2.0
#include "common/person_name.hpp"
#include "live/lease_text.hpp"
#include "live/people.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <iostream>

namespace cortex::cli {
namespace {

// A window or a shell, with who uses it.
struct Person {
    std::string name, tool, host, asks;
    std::vector<comms::ShownLease> holds;
    bool mine = false;
};

std::vector<Person> peopleOf(Live& live) {
    std::vector<Person> people;
    if (!live.person().empty()) {
        const std::string& own = live.mirror().name();
        people.push_back({live.person(),
                          own,
                          hostOf(live.mirror(), own),
                          live.leases().asking().prefix,
                          {},
                          true});
    }
    for (const comms::ToolStatus& each : live.mirror().tools()) {
        people.push_back({each.person, each.name, each.host, each.asks.prefix, {}, false});
    }
    std::ranges::sort(people, {},
                      [](const Person& each) { return std::tie(each.name, each.tool); });
    for (const comms::ShownLease& lease : shownLeases(live)) {
        const auto holder = std::ranges::find(people, lease.holder, &Person::tool);
        if (holder != people.end()) holder->holds.push_back(lease);
    }
    return people;
}

// Each prefix once, whatever number of agents gave it. `known`: all leases have come.
std::string holdsText(const Person& person, bool known) {
    std::vector<std::string> prefixes;
    for (const comms::ShownLease& each : person.holds) prefixes.push_back(each.prefix);
    std::ranges::sort(prefixes);
    const auto [first, last] = std::ranges::unique(prefixes);
    prefixes.erase(first, last);
    if (!known) prefixes.emplace_back("not told");
    return prefixes.empty() ? "-" : joined(prefixes);
}

Json personJson(const Person& person) {
    Json holds = Json::array();
    for (const comms::ShownLease& each : person.holds) {
        holds.push_back({{"agent", each.agent}, {"prefix", each.prefix}});
    }
    return {{"person", person.name}, {"tool", person.tool}, {"host", person.host},
            {"holds", holds},        {"asks", person.asks}, {"mine", person.mine}};
}

void printPeople(const Live& live, const std::vector<Person>& people, bool known) {
    if (people.empty()) {
        std::cout << "nobody is at a window or a shell of domain " << live.domain()
                  << "; 'cortex shell --name NAME' and 'cortex-explorer --name NAME' say who uses "
                     "them\n";
        return;
    }
    Columns columns{0};
    columns.add({"person", "tool", "host", "holds", "asks", ""});
    for (const Person& each : people) {
        columns.add({common::shownName(each.name), common::shownName(each.tool), each.host,
                     holdsText(each, known), each.asks.empty() ? "-" : each.asks,
                     each.mine ? "you" : ""});
    }
    columns.print(std::cout);
}

}  // namespace

// People are there without agents, too, and hold nothing then.
Exit listPeople(const LiveOptions& options) {
    Live live{options.network};
    waitForPeople(live);
    const bool agents = live.waitForAny();
    const std::string lacking = agents ? waitForLeases(live) : namelessText(live.nameless());
    if (options.json && !lacking.empty()) throw Failure{NotFound, lacking};
    const auto people = peopleOf(live);
    if (options.json) {
        Json list = Json::array();
        for (const Person& each : people) list.push_back(personJson(each));
        print(list);
        return Yes;
    }
    live.printClosed();
    printPeople(live, people, lacking.empty());
    if (!agents) std::cerr << "cortex: " << printable(live.nobody().what) << '\n';
    if (!lacking.empty()) throw Failure{NotFound, lacking};
    return Yes;
}

}  // namespace cortex::cli
