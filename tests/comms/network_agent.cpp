// SPDX-License-Identifier: Apache-2.0
#include "comms/network_agent.hpp"

#include <chrono>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cortex::comms {
namespace {

constexpr std::uint64_t greeting = 1'000'000'000;  // a number that no test comes to

}  // namespace

TypeModel changedTypes(const std::string& type, const std::function<void(DataItem&)>& change) {
    const TypeModel types = test::commandTypes();
    std::vector<TypeDeclaration> declarations;
    for (const auto& [name, declaration] : types.declarations()) {
        declarations.push_back(declaration);
        if (name != type) continue;
        for (DataItem& item : declarations.back().data) {
            // A declaration of its own states them; what files leave out is inherited.
            item.safe = {Safe::Kind::Hold, {}};
            change(item);
            if (item.max) declarations.back().stated.insert(item.name + ".max");
        }
    }
    Report report;
    TypeModel changed = TypeModel::build(std::move(declarations), report);
    if (!report.ok()) throw std::logic_error(report.text());
    return changed;
}

RawTool::RawTool(std::string toolName, const NetworkOptions& options)
    : name{std::move(toolName)},
      participant{options, name},
      presences{participant.writer<Presence>(topics::presence)},
      models{participant.writer<Model>(topics::model)},
      interests{participant.writer<Interest>(topics::interest)},
      commands{participant.writer<Command>(topics::command)},
      presenceReader{participant.reader<Presence>(topics::presence, heard.push())},
      answerReader{participant.reader<Answer>(topics::answerTo(name), [this](Answer&& answer) {
          (answer.sequenceNumber == greeting ? greetings : answers).push()(std::move(answer));
      })} {}

Presence RawTool::presence(const std::string& state) const {
    Presence message;
    message.agent = agentId(name);
    message.name = name;
    message.host = "desk";
    message.epoch = epoch;
    message.role = "tool";
    message.state = state;
    message.majors = {1};
    return message;
}

Interest RawTool::interest(Interest wanted) const {
    wanted.agent = agentId(name);
    wanted.name = name;
    wanted.epoch = epoch;
    return wanted;
}

Command RawTool::command(const Structure& target, const std::string& path,
                         const std::string& commandName, std::vector<NamedValue> arguments) {
    Command message;
    message.link = linkId(name, target.agent);
    message.sender = name;
    message.host = "desk";
    message.senderEpoch = epoch;
    message.target = target.agent;
    message.targetEpoch = target.epoch;
    message.sequenceNumber = ++sequence_;
    message.answeredBelow = 1;
    message.notAfter = 3'000'000;
    message.path = path;
    message.command = commandName;
    message.arguments = std::move(arguments);
    return message;
}

void RawTool::connect(std::uint32_t agents) {
    const bool connected = comesTrue([&] {
        // Its own reader hears its presence too.
        return commands->readers() >= agents && presences->readers() > agents;
    });
    // That its own endpoints found theirs does not say that theirs found its own already.
    if (!connected || !comesTrue([&] { return greet() >= agents; })) {
        throw std::logic_error("no agent listens to the test");
    }
}

std::size_t RawTool::greet() {
    const std::vector<Answer> answered = greetings.elements();
    std::set<std::string> met;
    for (const Answer& answer : answered) met.insert(answer.agent);
    for (const Presence& agent : heard.elements()) {
        if (agent.role == "tool" || met.contains(agent.name)) continue;
        Command nothing;
        nothing.link = linkId(name, agent.name);
        nothing.sender = name;
        nothing.senderEpoch = epoch;
        nothing.target = agent.name;
        nothing.targetEpoch = agent.epoch;
        nothing.sequenceNumber = greeting;
        commands->write(nothing);
    }
    // As clients repeat commands, unless an answer comes before.
    greetings.waitUntil([&](const auto& all) { return all.size() > answered.size(); },
                        std::chrono::milliseconds{5});
    return met.size();
}

}  // namespace cortex::comms
