// SPDX-License-Identifier: Apache-2.0
#include "session/lease_keeper.hpp"

#include "cortex/comms/security.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/path.hpp"

#include "common/leases_text.hpp"
#include "common/person_name.hpp"
#include "session/lease.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::chrono::seconds together{2};

using Leases = std::vector<comms::LeaseClient::Lease>;

// "Control of /arm of agent robot was lost: …."
std::string asSentence(std::string text) {
    if (!text.empty()) text.front() = static_cast<char>(std::toupper(text.front()));
    return text + '.';
}

// Where the folder cannot be read any longer, the agents alone say what is refused.
std::vector<std::string> rightsIn(const std::string& security) {
    std::vector<std::string> everything{"/"};
    try {
        return security.empty() ? everything : comms::checkSecurity(security).mayCommand;
    } catch (const Error&) {
        return everything;
    }
}

// By prefix, the agents that it is held of; without what goes along with a wider one.
std::map<std::string, std::vector<std::string>> widestOf(const Leases& held) {
    std::map<std::string, std::vector<std::string>> agents;
    for (const auto& each : held) {
        const bool goesAlong = std::ranges::any_of(held, [&](const auto& other) {
            return other.agent == each.agent && other.prefix != each.prefix &&
                   isAtOrBelow(each.prefix, other.prefix);
        });
        if (!goesAlong) agents[each.prefix].push_back(each.agent);
    }
    return agents;
}

std::string inWords(const std::vector<std::string>& prefixes) {
    std::string words;
    for (const std::string& each : prefixes) words += (words.empty() ? "" : " and ") + each;
    return words;
}

}  // namespace

// The session has the agents' own simplexes in its view.
LeaseKeeper::LeaseKeeper(comms::Mirror& mirror, const std::string& person,
                         const std::string& security)
    : mirror_{mirror}, client_{mirror} {
    control_.self = mirror.name();
    control_.person = person;
    control_.rights = rightsIn(security);
    client_.acceptOffers([] {});
}

void LeaseKeeper::take(const std::string& prefix, const Frame& frame) {
    if (taking_ != 0) {
        next_ = prefix;
        return;
    }
    const Leases held = client_.held();
    std::vector<std::string> agents;
    for (const AgentFrame& agent : frame.agents) {
        const bool ours = std::ranges::any_of(held, [&](const Lease& each) {
            return each.agent == agent.status.name && each.prefix == prefix;
        });
        if (!agent.lost() && !ours && hasBelow(agent, prefix)) agents.push_back(agent.status.name);
    }
    again_ = !agents.empty() && std::ranges::find(control_.claims, prefix) != control_.claims.end();
    inVain_ = false;
    control_.asks = prefix;
    taking_ = client_.take(prefix, agents);
}

void LeaseKeeper::release() {
    releaseAllBut({});
    control_.claims.clear();
    inVain_ = taking_ != 0;
    next_.clear();
}

void LeaseKeeper::releaseAllBut(const std::string& prefix) {
    control_.held = client_.held();
    for (const std::string& each : control_.prefixes()) {
        if (each != prefix) releasing_.push_back(client_.release(each));
    }
}

void LeaseKeeper::handOver(const std::string& to) {
    Giving giving{to, {}};
    for (const auto& [prefix, agents] : widestOf(client_.held()))
        giving.parts.push_back({client_.handOver(prefix, to, agents), {prefix}});
    if (giving.parts.empty()) return tell("Nothing was handed over: nothing is held.");
    givings_.push_back(std::move(giving));
}

// Once, also where the button is pressed twice.
void LeaseKeeper::grant(const Asked& asked) {
    const auto asks = client_.asked();
    const bool isOver = std::ranges::none_of(asks, [&](const Asked& each) {
        return each.tool == asked.tool && each.number == asked.number;
    });
    if (isOver || std::ranges::find(givings_, asked.tool, &Giving::to) != givings_.end()) return;
    Part part{client_.grant(asked), {}};
    for (const auto& [prefix, agents] : widestOf(asked.gives)) part.prefixes.push_back(prefix);
    const Leases held = client_.held();
    const bool keeps = std::ranges::any_of(held, [&](const Lease& each) {
        return std::ranges::find(part.prefixes, each.prefix) != part.prefixes.end() &&
               std::ranges::none_of(asked.gives, [&](const Lease& given) {
                   return given.agent == each.agent && given.prefix == each.prefix;
               });
    });
    if (keeps) part.words = common::leasesText(asked.gives);
    givings_.push_back({asked.tool, {std::move(part)}});
}

// What was said of a refusal is over.
void LeaseKeeper::ask(const std::string& prefix) {
    tell({});
    client_.ask(prefix);
}

void LeaseKeeper::withdraw() { client_.withdraw(); }

void LeaseKeeper::refuse(const Asked& asked) { client_.refuse(asked); }

void LeaseKeeper::step(const Frame& frame, bool renews) {
    client_.renew(renews);
    comms::LeaseClient::Answers answers;
    if (taking_ != 0 && client_.poll(taking_, answers)) finishTaking(answers);
    if (taking_ == 0 && !next_.empty()) take(std::exchange(next_, {}), frame);
    std::erase_if(givings_, [this](Giving& each) { return finishGiving(each); });
    std::erase_if(releasing_, [&](std::uint64_t each) { return client_.poll(each, answers); });
    const std::string sought = std::exchange(control_.asking, client_.asking()).prefix;
    std::string news;
    for (const std::string& each : client_.news())
        news += (news.empty() ? "" : " ") + asSentence(each);
    if (!news.empty()) {
        // What several agents say of one act comes one after the other.
        const auto now = std::chrono::steady_clock::now();
        if (now - lastNews_ < together && control_.notice == news_) news = news_ + " " + news;
        lastNews_ = now;
        tell(news);
        news_ = control_.notice;
        if (control_.asking.prefix.empty()) control_.sought = sought;
    }
    noteAll();
}

void LeaseKeeper::tell(const std::string& notice) {
    control_.notice = common::shownName(notice);
    ++control_.told;
    control_.handed.clear();
    control_.refused.clear();
    control_.refusals.clear();
    control_.sought.clear();
}

void LeaseKeeper::noteAll() {
    control_.tools = mirror_.tools();
    control_.asked = client_.asked();
    control_.held = client_.held();
    control_.prefix = control_.held.empty() ? "" : control_.held.front().prefix;
    control_.since = control_.held.empty() ? 0 : control_.held.front().since;
    if (!control_.prefix.empty()) control_.last = control_.prefix;
    for (const std::string& each : control_.prefixes()) {
        if (std::ranges::find(control_.claims, each) == control_.claims.end())
            control_.claims.push_back(each);
    }
}

// Who holds what of it is said by whoever shows the notice, as it is by then.
void LeaseKeeper::finishTaking(const comms::LeaseClient::Answers& answers) {
    taking_ = 0;
    const std::string prefix = std::exchange(control_.asks, {});
    std::vector<Control::Refusal> refusals;
    for (const auto& [agent, answer] : answers) {
        if (!answer.done()) refusals.push_back({agent, common::shownName(answer.text())});
    }
    const Leases held = client_.held();
    const bool holds = std::ranges::find(held, prefix, &Lease::prefix) != held.end();
    if (std::exchange(inVain_, false)) {
        if (holds) releasing_.push_back(client_.release(prefix));
    } else if (!refusals.empty()) {
        tell("Control of " + prefix + " was not taken.");
        control_.refused = prefix;
        control_.refusals = std::move(refusals);
    } else if (!holds) {
        tell("Nothing was taken: nobody who is heard has anything at or below " + prefix + ".");
    } else {
        tell({});
        if (again_) return;
        releaseAllBut(prefix);
        control_.claims = {prefix};
    }
}

bool LeaseKeeper::finishGiving(Giving& giving) {
    std::vector<std::string> given, kept;
    std::string refusals, words;
    for (Part& part : giving.parts) {
        comms::LeaseClient::Answers answers;
        if (!part.answered && !client_.poll(part.number, answers)) return false;
        part.answered = true;
        for (const auto& [name, answer] : answers) {
            if (!answer.done()) part.refusals += " " + name + ": " + answer.text() + ".";
        }
        refusals += part.refusals;
        words += part.words;
        std::ranges::copy(part.prefixes, std::back_inserter(part.refusals.empty() ? given : kept));
    }
    const std::string to = common::whoText(giving.to, common::personOf(control_.tools, giving.to));
    if (given.empty()) {
        tell("Control of " + (words.empty() ? inWords(kept) : words) + " was not handed over to " +
             to + "." + refusals);
        return true;
    }
    tell("Control of " + (words.empty() ? inWords(given) : words) + " was handed over to " + to +
         (kept.empty() ? "." : ", but not of " + inWords(kept) + "." + refusals));
    if (!words.empty()) return true;  // of the others it is held still
    std::erase_if(control_.claims, [&](const std::string& claim) {
        return std::ranges::any_of(
            given, [&](const std::string& each) { return isAtOrBelow(claim, each); });
    });
    control_.handed = std::move(given);
    return true;
}

}  // namespace cortex::gui
