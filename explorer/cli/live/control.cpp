// SPDX-License-Identifier: Apache-2.0
#include "live/control.hpp"

#include "cortex/core/path.hpp"

#include "live/lease_table.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace cortex::explorer {
namespace {

constexpr std::chrono::milliseconds toTell{1000}, toRelease{1000}, toTake{3000};
// Those of docs/protocol.md that need no lease.
constexpr std::array<std::string_view, 6> freeCommands{
    "shutdown", "cancel", "takeControl", "renewControl", "handOverControl", "releaseControl"};

std::string withoutEnd(const std::string& prefix) {
    const std::string_view trimmed = withoutEndSlashes(prefix);
    return trimmed.empty() ? "/" : std::string{trimmed};
}

// Who holds what an agent refused us; "" if the agent does not show it in time.
std::string holdersText(Live& live, const Leases::Key& key) {
    live.view({"/" + key.agent}, 100);
    live.mirror().waitForValues(std::max(live.left(), toTell));
    std::string text;
    for (const comms::AgentStatus& agent : live.mirror().agents()) {
        if (agent.name != key.agent) continue;
        for (const ShownLease& each : leasesOf(live.mirror(), agent)) {
            const bool common =
                isAtOrBelow(each.prefix, key.prefix) || isAtOrBelow(key.prefix, each.prefix);
            if (!common || each.holder == live.mirror().name()) continue;
            text += (text.empty() ? "" : ", ") + holderText(live.mirror(), each);
        }
    }
    return text;
}

[[noreturn]] void failToTake(Live& live, const Leases::Key& key,
                             const comms::CommandAnswer& answer) {
    const std::string start = "no control of " + key.prefix + " of agent " + key.agent + ": ";
    if (answer.outcome == Outcome::Unknown) throw Failure{NotFound, start + answer.text()};
    const std::string holders = answer.reason == Reason::Authority ? holdersText(live, key) : "";
    if (holders.empty()) throw Failure{No, start + answer.text()};
    throw Failure{No, start + holders +
                          "; the holder must release it or hand it over to you, nobody else can; "
                          "it ends 2 s after its holder ends ('cortex leases' shows all)"};
}

// The agents that have something at or below the prefix.
std::set<std::string> agentsBelow(Live& live, const std::string& prefix) {
    std::set<std::string> agents;
    for (const FoundSimplex& each : live.below(prefix)) agents.insert(each.agent);
    for (const comms::AgentStatus& each : live.mirror().agents()) {
        if (each.state == "lost") agents.erase(each.name);
    }
    if (agents.empty()) {
        throw Failure{NotFound, "no agent has anything at or below " + prefix +
                                    "; 'cortex list' shows what there is"};
    }
    return agents;
}

// What we hold with exactly this prefix.
std::vector<Leases::Key> heldAs(Live& live, const std::string& prefix) {
    std::vector<Leases::Key> keys = live.leases().held();
    std::vector<std::string> prefixes;
    for (const Leases::Key& each : keys) prefixes.push_back(each.prefix);
    std::erase_if(keys, [&](const Leases::Key& each) { return each.prefix != prefix; });
    if (!keys.empty()) return keys;
    throw Failure{No, "you do not hold " + prefix + "; you hold " +
                          (prefixes.empty() ? "nothing" : joined(prefixes))};
}

}  // namespace

void takeControl(Live& live, const std::string& prefix) {
    checkPrefix(prefix);
    live.waitForAll();
    const std::vector<Leases::Key> before = live.leases().held();
    std::vector<Leases::Key> taken;
    for (const std::string& agent : agentsBelow(live, prefix)) {
        const Leases::Key key{agent, withoutEnd(prefix)};
        if (std::ranges::find(before, key) != before.end()) continue;
        const comms::CommandAnswer answer = live.leases().take(key, std::min(live.left(), toTake));
        if (answer.done()) {
            taken.push_back(key);
            continue;
        }
        for (const Leases::Key& each : taken) live.leases().release(each, toRelease);
        failToTake(live, key, answer);
    }
}

void releaseControl(Live& live, const std::string& prefix) {
    for (const Leases::Key& each : heldAs(live, withoutEnd(prefix))) {
        const comms::CommandAnswer answer = live.leases().release(each, live.left());
        if (answer.done()) continue;
        throw Failure{answer.outcome == Outcome::Unknown ? NotFound : No,
                      prefix + " of agent " + each.agent + ": " + answer.text() +
                          "; it is not renewed any more and ends within 2 s"};
    }
}

void handOverControl(Live& live, const std::string& prefix, const std::string& to) {
    for (const Leases::Key& each : heldAs(live, withoutEnd(prefix))) {
        const comms::CommandAnswer answer = live.leases().handOver(each, to, live.left());
        if (answer.done()) continue;
        throw Failure{answer.outcome == Outcome::Unknown ? NotFound : No,
                      prefix + " of agent " + each.agent + ": " + answer.text()};
    }
}

std::optional<std::string> controlledBy(const FoundSimplex& simplex,
                                        const CommandTable::Entry& command,
                                        const comms::Mirror::Arguments& arguments) {
    if (std::ranges::find(freeCommands, command.name) != freeCommands.end()) return {};
    const ItemLayout* prefix = command.request.find("prefix");
    const bool toAgent = simplex.info().path == "/" + simplex.agent;
    if (!toAgent || prefix == nullptr) return simplex.info().path;
    const auto given = arguments.find("prefix");
    const Value& value = given != arguments.end() ? given->second : prefix->item->initial;
    const auto* text = std::get_if<std::vector<std::string>>(&value);
    return text != nullptr && text->size() == 1 ? withoutEnd(text->front()) : simplex.info().path;
}

BriefControl::BriefControl(Live& live, const std::string& agent, const std::string& prefix)
    : leases_{live.leases()} {
    if (leases_.covers(agent, prefix)) return;
    const Leases::Key key{agent, prefix};
    const comms::CommandAnswer answer = leases_.take(key, std::min(live.left(), toTake));
    if (!answer.done()) failToTake(live, key, answer);
    taken_ = key;
}

BriefControl::~BriefControl() {
    if (taken_) leases_.release(*taken_, toRelease);
}

}  // namespace cortex::explorer
