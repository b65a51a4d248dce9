// SPDX-License-Identifier: Apache-2.0
#include "session/holds.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace cortex::gui {

namespace {

using namespace std::chrono_literals;

constexpr auto hangs = 250ms;  // a window that was not seen for so long holds nothing down
constexpr auto endBudget = 1s;

}  // namespace

void Holds::begin(std::uint64_t number, HeldCommand command) {
    held_.push_back({number, std::move(command)});
}

void Holds::change(std::uint64_t number, comms::Mirror::Arguments arguments) {
    const auto found = std::ranges::find(held_, number, &Held::number);
    if (found != held_.end()) found->command.arguments = std::move(arguments);
}

void Holds::end(std::uint64_t number, const Frame& frame) {
    const auto found = std::ranges::find(held_, number, &Held::number);
    if (found == held_.end()) return;
    sayEnd(*found, frame);
    held_.erase(found);
}

std::vector<HoldEnd> Holds::step(const Frame& frame, Moment now, Moment alive) {
    std::vector<HoldEnd> ends = std::exchange(troubles_, {});
    std::erase_if(held_, [&](Held& each) {
        std::string why = whyNot(each, frame, now, alive);
        if (why.empty() && now >= each.due) {
            if (each.sent != 0) mirror_.abandon(each.sent);
            try {
                each.sent = mirror_.send(each.command.path, each.command.command,
                                         each.command.arguments, each.command.budget);
            } catch (const std::exception& error) {
                why = error.what();
            }
            each.due = std::max(each.due + each.command.every, now);
        }
        if (why.empty()) return false;
        sayEnd(each, frame);
        ends.push_back({each.number, std::move(why)});
        return true;
    });
    return ends;
}

std::string Holds::whyNot(Held& held, const Frame& frame, Moment now, Moment alive) {
    if (now - alive > hangs) return "the window hung";
    const auto place = frame.find(held.command.path);
    if (!place) return held.command.path + " is not heard";
    const AgentFrame& agent = frame.agents[place->agent];
    if (agent.lost()) return agent.status.name + " is not heard";
    if (!frame.control.covers(agent.status.name, held.command.path)) return "control was lost";
    comms::CommandAnswer answer;
    if (held.sent == 0 || !mirror_.poll(held.sent, answer)) return {};
    held.sent = 0;
    if (answer.done()) return {};
    // The agent may tell of it before the leases that it shows do.
    return answer.reason == Reason::Authority ? "control was lost: " + answer.why : answer.text();
}

// What stops it is sent also where control was lost: the agent decides. An agent that is gone has
// nothing left to stop.
void Holds::sayEnd(Held& held, const Frame& frame) {
    if (held.sent != 0) mirror_.abandon(held.sent);
    if (!held.command.atEnd || !frame.find(held.command.path)) return;
    try {
        mirror_.abandon(
            mirror_.send(held.command.path, held.command.command, *held.command.atEnd, endBudget));
    } catch (const std::exception& error) {
        troubles_.push_back({held.number, error.what()});
    }
}

}  // namespace cortex::gui
