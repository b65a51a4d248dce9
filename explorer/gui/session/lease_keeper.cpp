// SPDX-License-Identifier: Apache-2.0
#include "session/lease_keeper.hpp"

#include "cortex/comms/security.hpp"
#include "cortex/core/error.hpp"

#include "session/lease.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace cortex::gui {

namespace {

// "Control of /arm of agent robot was lost: …."
std::string asSentence(std::string text) {
    if (!text.empty()) text.front() = static_cast<char>(std::toupper(text.front()));
    return text + '.';
}

// Where the folder cannot be read any longer, the agents alone say what is refused.
std::vector<std::string> rightsIn(const std::string& security) {
    try {
        if (!security.empty()) return comms::checkSecurity(security).mayCommand;
    } catch (const Error&) {
    }
    return {"/"};
}

}  // namespace

// The session has the agents' own simplexes in its view.
LeaseKeeper::LeaseKeeper(comms::Mirror& mirror, const std::string& security) : client_{mirror} {
    control_.self = mirror.name();
    control_.rights = rightsIn(security);
    client_.acceptOffers([] {});
}

void LeaseKeeper::take(const std::string& prefix, const Frame& frame) {
    if (taking_ != 0) return;
    std::vector<std::string> agents;
    for (const AgentFrame& agent : frame.agents) {
        const bool ours =
            std::ranges::any_of(control_.held, [&](const comms::LeaseClient::Lease& each) {
                return each.agent == agent.status.name && each.prefix == prefix;
            });
        if (!agent.lost() && !ours && hasBelow(agent, prefix)) agents.push_back(agent.status.name);
    }
    again_ = !agents.empty() && std::ranges::find(control_.claims, prefix) != control_.claims.end();
    control_.asks = prefix;
    taking_ = client_.take(prefix, agents);
}

void LeaseKeeper::release() {
    releaseAllBut({});
    control_.claims.clear();
}

void LeaseKeeper::releaseAllBut(const std::string& prefix) {
    for (const std::string& each : control_.prefixes()) {
        if (each != prefix) releasing_.push_back(client_.release(each));
    }
}

void LeaseKeeper::handOver(const std::string& prefix, const std::string& to) {
    if (handing_ != 0) return;
    handed_ = prefix;
    to_ = to;
    handing_ = client_.handOver(prefix, to);
}

void LeaseKeeper::step(const Frame& frame, bool renews) {
    client_.renew(renews);
    comms::LeaseClient::Answers answers;
    if (taking_ != 0 && client_.poll(taking_, answers)) finishTaking(frame, answers);
    if (handing_ != 0 && client_.poll(handing_, answers)) finishHandOver(answers);
    std::erase_if(releasing_, [&](std::uint64_t each) { return client_.poll(each, answers); });
    const std::vector<std::string> news = client_.news();
    if (!news.empty()) tell(asSentence(news.back()));
    noteHeld();
}

void LeaseKeeper::tell(std::string notice) {
    control_.notice = std::move(notice);
    control_.handed.clear();
}

void LeaseKeeper::noteHeld() {
    control_.held = client_.held();
    control_.prefix = control_.held.empty() ? "" : control_.held.front().prefix;
    control_.since = control_.held.empty() ? 0 : control_.held.front().since;
    if (!control_.prefix.empty()) control_.last = control_.prefix;
    for (const std::string& each : control_.prefixes()) {
        if (std::ranges::find(control_.claims, each) == control_.claims.end())
            control_.claims.push_back(each);
    }
}

void LeaseKeeper::finishTaking(const Frame& frame, const comms::LeaseClient::Answers& answers) {
    taking_ = 0;
    const std::string prefix = std::exchange(control_.asks, {});
    std::string refusals;
    for (const auto& [name, answer] : answers) {
        if (answer.done()) continue;
        const auto agent = std::ranges::find(
            frame.agents, name, [](const AgentFrame& each) { return each.status.name; });
        const auto other = agent != frame.agents.end()
                               ? leaseOfOthers(*agent, prefix, control_.self)
                               : std::nullopt;
        refusals += " " + name + ": " +
                    (other ? other->holder + " holds " + other->prefix +
                                 ", and must release it or hand it over."
                           : answer.text() + ".");
    }
    control_.held = client_.held();
    const bool holds = std::ranges::find(control_.held, prefix,
                                         &comms::LeaseClient::Lease::prefix) != control_.held.end();
    if (!refusals.empty()) {
        tell("Control of " + prefix + " was not taken." + refusals);
    } else if (!holds) {
        tell("Nothing was taken: nobody who is heard has anything at or below " + prefix + ".");
    } else {
        tell({});
        if (again_) return;
        releaseAllBut(prefix);
        control_.claims = {prefix};
    }
}

void LeaseKeeper::finishHandOver(const comms::LeaseClient::Answers& answers) {
    handing_ = 0;
    std::string refusals;
    for (const auto& [name, answer] : answers) {
        if (!answer.done()) refusals += " " + name + ": " + answer.text() + ".";
    }
    tell("Control of " + handed_ +
         (refusals.empty() ? " was handed over to " + to_ + "."
                           : " was not handed over to " + to_ + "." + refusals));
    if (!refusals.empty()) return;
    std::erase(control_.claims, handed_);
    control_.handed = handed_;
}

}  // namespace cortex::gui
