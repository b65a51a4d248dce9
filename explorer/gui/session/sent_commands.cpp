// SPDX-License-Identifier: Apache-2.0
#include "session/sent_commands.hpp"

#include "common/to_its_sender.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace cortex::gui {

CommandOutcome notSent(const CommandRequest& request, std::string problem) {
    CommandOutcome outcome;
    outcome.number = request.number;
    outcome.path = request.path;
    outcome.command = request.command;
    outcome.problem = std::move(problem);
    return outcome;
}

std::vector<CommandOutcome> SentCommands::send(std::vector<CommandRequest> requests,
                                               const Frame& frame) {
    std::vector<CommandOutcome> outcomes;
    for (CommandRequest& each : requests) {
        try {
            const auto number = mirror_.send(each.path, each.command, each.arguments, each.budget);
            Sent sent{std::move(each), number, std::chrono::steady_clock::now()};
            if (const auto place = frame.find(sent.request.path)) {
                sent.agent = frame.agents[place->agent].status.name;
                sent.epoch = frame.agents[place->agent].status.epoch;
            }
            unanswered_.push_back(std::move(sent));
        } catch (const std::exception& error) {
            outcomes.push_back(notSent(each, error.what()));
        }
    }
    return outcomes;
}

std::vector<CommandOutcome> SentCommands::step(const Frame& frame) {
    std::vector<CommandOutcome> outcomes;
    const auto now = std::chrono::steady_clock::now();
    std::erase_if(unanswered_, [&](const Sent& each) {
        CommandOutcome outcome{
            each.request.number, each.request.path, each.request.command, {}, {}, 0};
        const bool answered = mirror_.poll(each.number, outcome.answer);
        if (!answered && now - each.since < each.request.limit && !isGone(each, frame))
            return false;
        if (!answered) {
            mirror_.abandon(each.number);
            outcome.answer.outcome = Outcome::Unknown;
        }
        outcome.answer.why = common::toItsSender(outcome.answer.why);
        outcomes.push_back(std::move(outcome));
        return true;
    });
    return outcomes;
}

// Whether the agent that the command went to is lost, or has started anew.
bool SentCommands::isGone(const Sent& sent, const Frame& frame) {
    if (sent.agent.empty()) return false;
    const auto agent = std::ranges::find(frame.agents, sent.agent,
                                         [](const AgentFrame& each) { return each.status.name; });
    return agent == frame.agents.end() || agent->lost() || agent->status.epoch != sent.epoch;
}

}  // namespace cortex::gui
