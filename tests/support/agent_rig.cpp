// SPDX-License-Identifier: Apache-2.0
#include "agent_rig.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/command_exchange.hpp"
#include "cortex/core/framework_item.hpp"
#include "cortex/core/record.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace cortex::test {

TypeModel commandTypes() {
    return TypeModel::load(std::filesystem::path{CORTEX_SOURCE_DIR} /
                           "tests/data/command-rules.xml");
}

void Hand::on(std::string_view command, Function function) {
    functions_.push_back(std::move(function));
    handle(command, {&functions_.back(), [](void* object, Call& call) {
                         return (*static_cast<Function*>(object))(call);
                     }});
}

void PlayedInterface::read(Inbox& inbox) {
    for (const auto& function : std::exchange(reads_, {})) function(inbox);
}

void PlayedInterface::write(std::int64_t, Outbox& outbox) {
    OutsideAnswer answer;
    while (outbox.nextAnswer(answer)) {
        answers.push_back({std::string{answer.sender.nameText()},
                           answer.sequence,
                           answer.outcome,
                           answer.reason,
                           std::string{answer.why.view()},
                           answer.latencyCycles,
                           {answer.response, answer.response + answer.size}});
    }
}

void PlayedInterface::send(const Message& message) {
    atRead([this, message](Inbox& inbox) {
        const Structure& structure = *access.structure;
        OutsideCommand command;
        std::ranges::copy(message.sender, command.sender.name.begin());
        std::ranges::copy(message.host, command.sender.host.begin());
        std::ranges::copy(message.onBehalfOf, command.onBehalfOf.begin());
        command.sender.epoch = message.epoch;
        command.targetEpoch = message.targetEpoch != 0 ? message.targetEpoch : structure.epoch;
        command.sequence = message.sequence;
        command.answeredBelow = message.answeredBelow;
        command.notAfter = message.notAfter;
        command.until = message.until;
        command.simplex = structure.find(message.path);
        std::vector<std::uint64_t> record(1);
        if (command.simplex != noSimplex) {
            const CommandTable table =
                commandTable(*structure.simplexes[command.simplex].layout->type);
            command.command = table.find(message.command);
            if (command.command != CommandTable::none) {
                const auto& entry = table.entries[command.command];
                record.resize(entry.request.size / 8 + 2);
                command.size = entry.request.size + static_cast<std::uint32_t>(message.sizeError);
                encodeRecord(table, command.command, message.arguments,
                             reinterpret_cast<std::byte*>(record.data()));
            }
        }
        command.request = reinterpret_cast<const std::byte*>(record.data());
        inbox.command(command);
    });
}

void PlayedInterface::loseSender(const std::string& name, std::int64_t epoch) {
    atRead([name, epoch](Inbox& inbox) {
        Sender sender;
        std::ranges::copy(name, sender.name.begin());
        sender.epoch = epoch;
        inbox.senderLost(sender);
    });
}

PlayedInterface::Answer PlayedInterface::last() const {
    if (answers.empty()) throw std::logic_error("no answer came");
    return answers.back();
}

AgentRig::AgentRig(std::string name, AgentOptions options)
    : AgentRig{commandTypes(), std::move(name), options} {}

AgentRig::AgentRig(TypeModel types, std::string name, AgentOptions options)
    : tree{std::move(types)}, name_{std::move(name)}, options_{options} {
    interfaces_.push_back(&outside);
}

AgentRig::~AgentRig() {
    if (agent) agent->stop();
}

void AgentRig::make() {
    options_.imageKeepers = static_cast<std::uint32_t>(interfaces_.size());
    agent = std::make_unique<AgentRuntime>(name_, tree, options_);
    agent->events().addSink([this](const Event& event, const Structure& structure) {
        const std::string path =
            event.simplex == noSimplex ? "" : structure.simplexes[event.simplex].path;
        const std::lock_guard lock{mutex_};
        events_.push_back(path + ": " + std::string{event.text.view()});
    });
    for (CommunicationInterface* interface : interfaces_) agent->addInterface(*interface);
}

void AgentRig::start() {
    if (!agent) make();
    if (!order.empty()) {
        std::vector<std::uint32_t> canonical;
        for (const auto& path : order) canonical.push_back(agent->structure().find(path));
        agent->setCanonicalOrder(canonical);
    } else {
        for (const auto& info : agent->structure().simplexes) {
            if (!info.remote) order.push_back(info.path);
        }
    }
    agent->start();
}

void AgentRig::begin() {
    ++tick.cycle;
    tick.nominalTime += options_.period;
    tick.passed = tick.elapsed = options_.period;
    agent->beginCycle(tick);
}

void AgentRig::runTasks() {
    for (const auto& path : order) {
        auto* hand = dynamic_cast<Hand*>(tree.find(path));
        if (hand == nullptr) continue;
        if (AgentRuntime::hasCommandWork(agent->calls(hand->index()))) {
            agent->processCommands(hand->index(), hand->state, agent->thread(0));
        }
        if (hand->run) hand->run();
    }
}

void AgentRig::end() { agent->endCycle(tick, 0); }

void AgentRig::step(int cycles) {
    for (int i = 0; i < cycles; ++i) {
        begin();
        runTasks();
        end();
    }
}

void AgentRig::setState(Hand& hand, State state) {
    hand.state = state;
    frameworkItem<std::int64_t>(*agent, hand.index(), "state") = static_cast<std::int64_t>(state);
}

std::vector<std::string> AgentRig::events() {
    agent->events().flush();
    const std::lock_guard lock{mutex_};
    return events_;
}

bool AgentRig::hasEvent(std::string_view part) {
    const auto all = events();
    return std::ranges::any_of(
        all, [&](const auto& text) { return text.find(part) != std::string::npos; });
}

}  // namespace cortex::test
