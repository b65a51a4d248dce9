// SPDX-License-Identifier: Apache-2.0
#include "leases/control_asks.hpp"

#include "cortex/core/path.hpp"

#include "leases/lease_table.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cortex::comms {
namespace {

using Asked = LeaseClient::Asked;
using Holder = LeaseClient::Holder;
using Lease = LeaseClient::Lease;

constexpr std::chrono::seconds untilShown{1};  // a lease that was refused to us a moment ago
constexpr std::chrono::minutes longestAsk{2};
constexpr std::chrono::milliseconds untilItCounts{300};  // so that nobody floods a person
constexpr std::ptrdiff_t mostTold = 8;                   // refusals

// Whether a lease on one path concerns what the agent has at and below another one.
bool concerns(const Mirror& mirror, const std::string& agent, const std::string& leased,
              const std::string& prefix) {
    if (isAtOrBelow(leased, prefix)) return true;
    if (!isAtOrBelow(prefix, leased)) return false;
    const auto structure = mirror.structure(agent);
    return structure != nullptr &&
           std::ranges::any_of(structure->simplexes, [&](const SimplexInfo& info) {
               return !info.remote && isAtOrBelow(info.path, prefix);
           });
}

// All leases that concern what lies at and below it, as agents show them.
std::vector<ShownLease> leasesAbout(const Mirror& mirror, const std::string& prefix) {
    std::vector<ShownLease> all;
    for (const AgentStatus& agent : mirror.agents()) {
        for (ShownLease& each : leasesOf(agent, mirror.image(agent.name))) {
            if (concerns(mirror, agent.name, each.prefix, prefix)) all.push_back(std::move(each));
        }
    }
    return all;
}

std::vector<ToolStatus>::const_iterator find(const std::vector<ToolStatus>& tools,
                                             const std::string& name) {
    return std::ranges::find(tools, name, &ToolStatus::name);
}

std::string namesOf(const std::vector<Holder>& holders) {
    std::string names;
    for (const Holder& each : holders)
        names += (names.empty() ? "" : ", ") + whoText(each.name, each.person);
    return names;
}

}  // namespace

std::vector<Holder> holdersOf(const Mirror& mirror, const std::string& prefix) {
    std::map<std::string, Holder> holders;
    for (const ShownLease& each : leasesAbout(mirror, prefix)) {
        if (each.holder == mirror.name()) continue;
        holders[each.holder].holds.push_back({each.agent, each.prefix, each.since});
    }
    const auto tools = mirror.tools();
    std::vector<Holder> list;
    for (auto& [name, holder] : holders) {
        holder.name = name;
        if (const auto tool = find(tools, name); tool != tools.end()) holder.person = tool->person;
        list.push_back(std::move(holder));
    }
    return list;
}

void ControlAsks::ask(const std::string& prefix, Moment now) {
    if (own_.number != 0 && own_.prefix == prefix) return;
    tell({last_ + 1, prefix});
    own_ = {++last_, prefix};
    begun_ = now;
    holders_ = holdersOf(mirror_, prefix);
    met_ = !holders_.empty();
}

void ControlAsks::withdraw() {
    own_ = {};
    holders_.clear();
    tell(own_);
}

LeaseClient::Asking ControlAsks::asking() const { return {own_.prefix, holders_}; }

// Whoever reads a refusal asks no longer: only those who do not are ever left out.
void ControlAsks::tell(const ControlAsk& asks) {
    const auto most = std::min(std::ssize(refused_), mostTold);
    mirror_.tellAsks(asks, {refused_.end() - most, refused_.end()});
}

std::vector<Asked> ControlAsks::asked(const Leases& held) const {
    std::vector<Asked> list;
    const Moment now = std::chrono::steady_clock::now();
    for (const ToolStatus& tool : mirror_.tools()) {
        const Named named{tool.name, tool.asks.number};
        const auto came = std::ranges::find(came_, named, &Came::named);
        if (came == came_.end() || now - came->when < untilItCounts) continue;
        if (std::ranges::find(refused_, named) != refused_.end()) continue;
        Asked asked{tool.name, tool.person, tool.asks.prefix, tool.asks.number, {}};
        for (const Lease& each : held) {
            if (concerns(mirror_, each.agent, each.prefix, asked.prefix))
                asked.gives.push_back(each);
        }
        if (!asked.gives.empty()) list.push_back(std::move(asked));
    }
    std::ranges::sort(list, {}, [&](const Asked& each) {
        return std::ranges::find(came_, Named{each.tool, each.number}, &Came::named);
    });
    return list;
}

void ControlAsks::refuse(const Asked& asked) {
    refused_.emplace_back(asked.tool, asked.number);
    tell(own_);
}

void ControlAsks::step(Moment now, std::vector<std::string>& news) {
    const auto tools = mirror_.tools();
    const auto isOver = [&](const Named& each) {
        const auto tool = find(tools, each.first);
        return tool == tools.end() || tool->asks.number != each.second;
    };
    std::erase_if(came_, [&](const Came& each) { return isOver(each.named); });
    for (const ToolStatus& each : tools) {
        const Named named{each.name, each.asks.number};
        if (each.asks.number != 0 && std::ranges::find(came_, named, &Came::named) == came_.end())
            came_.push_back({named, now});
    }
    if (std::erase_if(refused_, isOver) > 0) tell(own_);
    if (own_.number != 0) follow(now, news);
}

// Of an agent that is there and does not show its leases now, as another part of the plant is
// viewed, the last ones hold. True: there is such an agent.
bool ControlAsks::addUnshown(const std::vector<Holder>& before) {
    bool any = false;
    for (const AgentStatus& agent : mirror_.agents()) {
        if (agent.state == "lost" || shownLeases(agent, mirror_.image(agent.name))) continue;
        any = any || concerns(mirror_, agent.name, "/", own_.prefix);
        for (const Holder& holder : before) {
            for (const Lease& each : holder.holds) {
                if (each.agent != agent.name) continue;
                auto known = std::ranges::find(holders_, holder.name, &Holder::name);
                if (known == holders_.end())
                    known = holders_.insert(known, {holder.name, holder.person, {}});
                known->holds.push_back(each);
            }
        }
    }
    std::ranges::sort(holders_, {}, &Holder::name);
    return any;
}

// Whoever handed over is no holder any more, and we are told so by what is ours now.
void ControlAsks::follow(Moment now, std::vector<std::string>& news) {
    const std::vector<Holder> before = std::exchange(holders_, holdersOf(mirror_, own_.prefix));
    const bool isUnknown = addUnshown(before);
    met_ = met_ || !holders_.empty();
    if (holders_.empty()) {
        if (isUnknown && now - begun_ <= longestAsk) return;
        if (!met_ && now - begun_ < untilShown) return;
        const bool ours = std::ranges::any_of(
            leasesAbout(mirror_, own_.prefix),
            [&](const ShownLease& each) { return each.holder == mirror_.name(); });
        return end(
            ours ? "" : "nobody else holds a part of " + own_.prefix + " now, so it can be taken",
            news);
    }
    const auto tools = mirror_.tools();
    std::size_t refusals = 0, silent = 0;
    for (Holder& each : holders_) {
        const auto tool = find(tools, each.name);
        each.refused = tool != tools.end() &&
                       std::ranges::find(tool->refuses, Named{mirror_.name(), own_.number}) !=
                           tool->refuses.end();
        refusals += each.refused ? 1 : 0;
        silent += each.person.empty() ? 1 : 0;
    }
    if (refusals > 0 && refusals + silent == holders_.size()) {
        std::erase_if(holders_, [](const Holder& each) { return !each.refused; });
        end("control of " + own_.prefix + " was refused to you by " + namesOf(holders_), news);
    } else if (silent == holders_.size()) {
        end("nobody can be asked for control of " + own_.prefix + ": " + namesOf(holders_) +
                " does not say who uses it",
            news);
    } else if (now - begun_ > longestAsk) {
        end("control of " + own_.prefix + " is not yours: " + namesOf(holders_) +
                " has not answered in two minutes",
            news);
    }
}

void ControlAsks::end(std::string why, std::vector<std::string>& news) {
    if (!why.empty()) news.push_back(std::move(why));
    withdraw();
}

}  // namespace cortex::comms
