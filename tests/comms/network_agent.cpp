// SPDX-License-Identifier: Apache-2.0
#include "comms/network_agent.hpp"

#include <stdexcept>

namespace cortex::comms {

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
      commands{participant.writer<Command>(topics::command)},
      presenceReader{participant.reader<Presence>(topics::presence, heard.push())},
      answerReader{participant.reader<Answer>(topics::answer, answers.push())} {}

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

Model RawTool::interest(Interest wanted) const {
    Model model;
    model.id = modelId(name, "interest", wanted.target);
    model.agent = name;
    model.epoch = epoch;
    model.interests.push_back(std::move(wanted));
    return model;
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
        return commands->readers() >= agents && answerReader->writers() >= agents &&
               presences->readers() > agents;
    });
    if (!connected) throw std::logic_error("no agent listens to the test");
}

}  // namespace cortex::comms
