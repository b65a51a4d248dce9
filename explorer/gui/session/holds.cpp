// SPDX-License-Identifier: Apache-2.0
#include "session/holds.hpp"

#include "cortex/core/value.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace cortex::gui {

namespace {

using namespace std::chrono_literals;

constexpr auto hangs = 250ms;  // a window that was not seen for so long holds nothing down
constexpr auto endBudget = 1s;
constexpr auto leastPatience = 100ms;  // the session looks for answers 30 times a second

// After it the agent may have let end what is held, and would begin anew with the next one.
std::chrono::nanoseconds patienceFor(const HeldCommand& command) {
    return std::max({command.budget, 2 * command.every, std::chrono::milliseconds{leastPatience}});
}

std::string silenceText(const std::string& path, std::chrono::duration<double> silence) {
    return path + " did not answer for " + toText(std::round(silence.count() * 100) / 100) + " s";
}

// Of an answer that is no success: what the agent says, without the name of the outcome.
std::string endText(const comms::CommandAnswer& answer) {
    const std::string text = answer.why.empty() ? answer.text() : answer.why;
    // The agent may tell of it before the leases that it shows do.
    return answer.reason == Reason::Authority ? "control was lost: " + text : text;
}

}  // namespace

void Holds::begin(std::uint64_t number, HeldCommand command) {
    held_.push_back({number, std::move(command), {}});
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
        if (each.executed == Moment{}) each.executed = now;
        std::string why = whyNot(each, frame, now, alive);
        if (why.empty() && now >= each.due) {
            try {
                each.sent.push_back({mirror_.send(each.command.path, each.command.command,
                                                  each.command.arguments, each.command.budget),
                                     now});
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
    return whyNotAnswered(held, now);
}

std::string Holds::whyNotAnswered(Held& held, Moment now) {
    std::string why;
    std::erase_if(held.sent, [&](const Sent& each) {
        comms::CommandAnswer answer;
        if (!mirror_.poll(each.number, answer)) return false;
        if (answer.done()) {
            held.executed = std::max(held.executed, each.at + answer.latency);
        } else if (why.empty()) {
            why = endText(answer);
        }
        return true;
    });
    const auto silence = now - held.executed;
    const bool tooLong = why.empty() && silence > patienceFor(held.command);
    return tooLong ? silenceText(held.command.path, silence) : why;
}

void Holds::abandon(const Held& held) {
    for (const Sent& each : held.sent) mirror_.abandon(each.number);
}

// What stops it is sent also where control was lost: the agent decides. An agent that is gone has
// nothing left to stop.
void Holds::sayEnd(Held& held, const Frame& frame) {
    abandon(held);
    if (!held.command.atEnd || !frame.find(held.command.path)) return;
    try {
        mirror_.abandon(
            mirror_.send(held.command.path, held.command.command, *held.command.atEnd, endBudget));
    } catch (const std::exception& error) {
        troubles_.push_back({held.number, error.what()});
    }
}

}  // namespace cortex::gui
