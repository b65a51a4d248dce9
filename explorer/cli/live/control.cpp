// SPDX-License-Identifier: Apache-2.0
#include "live/control.hpp"

#include "cortex/core/path.hpp"

#include "common/needed_control.hpp"
#include "live/lease_text.hpp"
#include "live/people.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <thread>

namespace cortex::cli {
namespace {

using Lease = comms::LeaseClient::Lease;

constexpr std::chrono::milliseconds toTell{1000};

using common::withoutEnd;

// Who holds what an agent refused us; "" if the agent does not show it in time.
std::string holdersText(Live& live, const Lease& key) {
    live.view({"/" + key.agent}, 100);
    live.mirror().waitForValues(std::max(live.left(), toTell));
    auto leases = shownLeases(live);
    std::erase_if(leases, [&](const comms::ShownLease& each) {
        const bool common =
            isAtOrBelow(each.prefix, key.prefix) || isAtOrBelow(key.prefix, each.prefix);
        return each.agent != key.agent || !common || each.holder == live.mirror().name();
    });
    std::vector<std::string> holders, texts;
    for (const auto& each : leases) holders.push_back(each.holder);
    waitForPeople(live, holders);
    for (const auto& each : leases) texts.push_back(holderText(live, each));
    return joined(texts);
}

// No refusal: the agent was not heard, or its loop did not go on. To take control again does no
// harm.
bool isSilence(const comms::CommandAnswer& answer) {
    return answer.outcome == Outcome::Unknown || answer.outcome == Outcome::Expired ||
           answer.outcome == Outcome::MailboxFull;
}

[[noreturn]] void failToTake(Live& live, const Lease& key, const comms::CommandAnswer& answer) {
    const std::string start = "no control of " + key.prefix + " of agent " + key.agent + ": ";
    if (isSilence(answer)) throw Failure{NotFound, start + answer.text()};
    const std::string holders = lacksControl(answer) ? holdersText(live, key) : "";
    if (holders.empty()) throw Failure{No, start + answer.text()};
    throw Failure{No, start + holders +
                          "; the holder must release it or hand it over to you, nobody else can; "
                          "it ends 2 s after its holder ends ('cortex leases' shows all, 'ask " +
                          key.prefix + "' in 'cortex shell' asks for it)"};
}

// Tries again while an agent is silent and time is left. A refusal is final.
void takeFrom(Live& live, const std::string& prefix, const std::vector<std::string>& agents) {
    comms::LeaseClient& leases = live.leases();
    for (;;) {
        const comms::LeaseClient::Answers answers = leases.wait(leases.take(prefix, agents));
        const comms::LeaseClient::Answer* silent = nullptr;
        for (const auto& each : answers) {
            if (each.answer.done()) continue;
            if (!isSilence(each.answer)) failToTake(live, {each.agent, prefix}, each.answer);
            silent = &each;
        }
        if (silent == nullptr) return;
        if (live.over()) failToTake(live, {silent->agent, prefix}, silent->answer);
        throwIfInterrupted();
        std::this_thread::sleep_for(std::min(live.left(), interruptSlice));
    }
}

// Throws Failure unless we hold exactly this prefix.
void checkHeld(Live& live, const std::string& prefix) {
    std::vector<std::string> prefixes;
    for (const Lease& each : live.leases().held()) {
        if (each.prefix == prefix) return;
        prefixes.push_back(each.prefix);
    }
    throw Failure{No, "you do not hold " + prefix + "; you hold " +
                          (prefixes.empty() ? "nothing" : joined(prefixes))};
}

// Throws Failure at the first agent that did not do it.
void checkAnswers(const comms::LeaseClient::Answers& answers, const std::string& prefix,
                  const std::string& then) {
    for (const auto& [agent, answer] : answers) {
        if (answer.done()) continue;
        throw Failure{answer.outcome == Outcome::Unknown ? NotFound : No,
                      prefix + " of agent " + agent + ": " + answer.text() + then};
    }
}

}  // namespace

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

void takeControl(Live& live, const std::string& prefix) {
    checkPrefix(prefix);
    live.waitForAll(prefix);
    const std::string wanted = withoutEnd(prefix);
    std::set<std::string> agents = agentsBelow(live, prefix);
    for (const Lease& each : live.leases().held()) {
        if (each.prefix == wanted) agents.erase(each.agent);
    }
    takeFrom(live, wanted, {agents.begin(), agents.end()});
}

void releaseControl(Live& live, const std::string& prefix) {
    checkHeld(live, withoutEnd(prefix));
    checkAnswers(live.leases().wait(live.leases().release(withoutEnd(prefix))), prefix,
                 "; it is not renewed any more and ends within 2 s");
}

void handOverControl(Live& live, const std::string& prefix, const std::string& to) {
    checkHeld(live, withoutEnd(prefix));
    checkAnswers(live.leases().wait(live.leases().handOver(withoutEnd(prefix), to)), prefix, "");
}

std::optional<std::string> controlledBy(const FoundSimplex& simplex,
                                        const CommandTable::Entry& command,
                                        const comms::Mirror::Arguments& arguments) {
    const ItemLayout* prefix = command.request.find("prefix");
    return common::neededControl(simplex.info().path, simplex.info().path == "/" + simplex.agent,
                                 command.name, prefix == nullptr ? nullptr : prefix->item,
                                 arguments);
}

bool lacksControl(const comms::CommandAnswer& answer) {
    return answer.reason == Reason::Authority &&
           (answer.why.find(" is held by ") != std::string::npos ||
            answer.why.starts_with("control is required"));
}

std::string authorityHint(const comms::CommandAnswer& answer) {
    if (lacksControl(answer)) {
        return "cortex: --take takes control for one command; 'cortex leases' shows who has it\n";
    }
    const bool lacksRight = answer.why.starts_with("it may only look") ||
                            answer.why.starts_with("its authority ends at ");
    if (!lacksRight) return {};
    return "cortex: the security folder of this tool gives it no such right ('cortex security show "
           "FOLDER'); 'cortex security create-agent' makes one with more\n";
}

BriefControl::BriefControl(Live& live, const std::string& agent, const std::string& prefix)
    : leases_{live.leases()}, agent_{agent}, prefix_{prefix} {
    if (leases_.covers(agent, prefix)) return;
    takeFrom(live, prefix, {agent});
    taken_ = true;
}

BriefControl::~BriefControl() {
    if (taken_) leases_.wait(leases_.release(prefix_, {agent_}));
}

}  // namespace cortex::cli
