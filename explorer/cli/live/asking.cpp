// SPDX-License-Identifier: Apache-2.0
#include "live/asking.hpp"

#include "common/leases_text.hpp"
#include "common/needed_control.hpp"
#include "common/person_name.hpp"
#include "live/control.hpp"
#include "live/lease_text.hpp"
#include "live/people.hpp"

#include <algorithm>

namespace cortex::cli {
namespace {

using Holder = comms::LeaseClient::Holder;
using Texts = std::vector<std::string>;

bool isAgent(Live& live, const std::string& name) {
    return std::ranges::any_of(live.mirror().agents(),
                               [&](const auto& each) { return each.name == name; });
}

std::vector<Holder> holdersOf(Live& live, const std::string& prefix) {
    const std::string lacking = waitForLeases(live);
    Texts names;
    for (const Holder& each : live.leases().holdersOf(prefix)) names.push_back(each.name);
    // Others may hold a part, too; but those who are known can be asked.
    if (names.empty() && !lacking.empty()) throw Failure{NotFound, lacking};
    waitForPeople(live, names);
    return live.leases().holdersOf(prefix);
}

[[noreturn]] void failWithoutHolder(Live& live, const std::string& prefix) {
    const auto agents = agentsBelow(live, prefix);
    const bool ours = std::ranges::all_of(
        agents, [&](const auto& each) { return live.leases().covers(each, prefix); });
    throw Failure{
        No, ours ? "you control " + prefix + " yourself"
                 : "nobody else holds a part of " + prefix + ": 'take " + prefix + "' takes it"};
}

std::string whyNotAsked(Live& live, const Holder& holder) {
    return common::whoText(holder.name, "") + " holds " + common::leasesText(holder.holds) +
           (isAgent(live, holder.name) ? " and is an agent"
                                       : " and does not say who uses it (a single verb, a program, "
                                         "or an earlier version)");
}

// "bob (cortex@vm.1-a) for /drive, alice (cortex@vm.2-b) for /": whoever is to choose.
std::string listOf(const std::vector<Asked>& all) {
    Texts names;
    for (const Asked& each : all) {
        names.push_back(common::whoText(each.tool, each.person) + " for " + each.prefix);
    }
    return joined(names);
}

bool isHolder(Live& live, const std::string& name) {
    const auto leases = shownLeases(live);
    return std::ranges::find(leases, name, &comms::ShownLease::holder) != leases.end();
}

}  // namespace

std::vector<std::string> askForControl(Live& live, const std::string& prefix) {
    checkPrefix(prefix);
    live.waitForAll(prefix);
    agentsBelow(live, prefix);
    const std::string wanted = common::withoutEnd(prefix);
    const auto holders = holdersOf(live, wanted);
    if (holders.empty()) failWithoutHolder(live, wanted);
    Texts lines, others;
    for (const Holder& each : holders) {
        if (each.person.empty()) others.push_back(whyNotAsked(live, each));
        if (each.person.empty()) continue;
        lines.push_back(common::whoText(each.name, each.person) + " is asked, and holds " +
                        common::leasesText(each.holds));
    }
    if (lines.empty()) {
        throw Failure{No, "nobody can be asked for " + wanted + ": " + joined(others) +
                              "; wait until it is released ('leases' shows it)"};
    }
    for (const std::string& each : others) lines.push_back("not asked: " + each);
    live.leases().ask(wanted);
    return lines;
}

std::string withdrawAsk(Live& live) {
    std::string prefix = live.leases().asking().prefix;
    if (prefix.empty()) throw Failure{No, "you ask for nothing"};
    live.leases().withdraw();
    return prefix;
}

Asked askedBy(Live& live, const std::string& name) {
    const auto all = live.leases().asked();
    if (all.empty()) throw Failure{No, "nobody asks for anything that you hold"};
    const auto meant = name.empty() ? all : meantBy(name, all);
    if (meant.size() == 1) return meant.front();
    if (meant.empty()) {
        throw Failure{No, "nobody called '" + common::shownName(name) +
                              "' asks for anything that you hold, but " + listOf(all)};
    }
    throw Failure{
        No, "several ask: " + listOf(meant) + "; name one, such as " + wordFor(meant.front(), all)};
}

void grantControl(Live& live, const Asked& asked) {
    for (const auto& [agent, answer] : live.leases().wait(live.leases().grant(asked))) {
        if (answer.done()) continue;
        throw Failure{answer.outcome == Outcome::Unknown ? NotFound : No,
                      "control of agent " + agent + " was not handed over: " + answer.text()};
    }
    live.askNews().answered(asked);
}

void refuseControl(Live& live, const Asked& asked) {
    live.leases().refuse(asked);
    live.askNews().answered(asked);
}

std::string recipientOf(Live& live, const std::string& name) {
    if (isAgent(live, name) || isHolder(live, name) || name == live.mirror().name()) return name;
    waitForPeople(live, {name});
    Texts meant;
    for (const comms::ToolStatus& each : live.mirror().tools()) {
        if (each.name == name) return name;
        if (each.person == name && !isNameOfTool(name)) meant.push_back(each.name);
    }
    const std::string shown = common::shownName(name);
    if (meant.size() == 1) return meant.front();
    if (meant.size() > 1) {
        throw Failure{No, "several tools say that " + shown +
                              " uses them, so name one by its whole name: " + joined(meant)};
    }
    if (isNameOfTool(name)) return name;
    throw Failure{NotFound, "no agent, tool or person is called '" + shown +
                                "'; 'people' and 'agents' show who is there"};
}

}  // namespace cortex::cli
