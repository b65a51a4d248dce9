// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/record.hpp"
#include "cortex/core/transport.hpp"

#include "support/agent_rig.hpp"
#include "toolkit/allocation_counter.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

inline constexpr int longestWait = 450;  // cycles of 1 ms
using NamedArguments = std::map<std::string, Value>;

struct Sent {
    std::uint64_t number;
    std::string path = "/worker", command = "add";
    NamedArguments arguments = {};
    std::uint64_t below = 1;
    std::int64_t epoch = 1;
    std::int64_t budget = 10'000;  // cycles
    bool refused = false;
};

struct Answered {
    std::uint64_t number;
    Outcome outcome;
    bool operator==(const Answered&) const = default;
};

// Hands over what is prepared, and allocates nothing in the loop.
class PreparedInterface final : public CommunicationInterface {
public:
    void announce(const AgentAccess& agent) override {
        structure = agent.structure;
        answers.reserve(1000);
        whys.reserve(1000);
    }
    void send(const Sent& sent, std::int64_t cycle) {
        OutsideCommand& command = commands.emplace_back();
        std::ranges::copy(std::string{"tool"}, command.sender.name.begin());
        command.sender.epoch = sent.epoch;
        command.targetEpoch = structure->epoch;
        command.sequence = sent.number;
        command.answeredBelow = sent.below;
        command.notAfter = cycle + 1 + sent.budget;
        command.refused = sent.refused;
        command.simplex = structure->find(sent.path);
        const CommandTable table =
            commandTable(*structure->simplexes[command.simplex].layout->type);
        command.command = table.find(sent.command);
        command.size = table.entries[command.command].request.size;
        auto& record = records.emplace_back(command.size / 8 + 1);
        auto arguments = sent.arguments;
        if (sent.command == "add") {
            arguments["amount"] = Value{std::vector{static_cast<double>(sent.number)}};
        }
        encodeRecord(table, command.command, arguments,
                     reinterpret_cast<std::byte*>(record.data()));
        command.request = reinterpret_cast<const std::byte*>(record.data());
    }
    void read(Inbox& inbox) override {
        if (lose) inbox.senderLost(commands.back().sender);
        for (std::size_t i = read_; i < commands.size(); ++i) inbox.command(commands[i]);
        read_ = commands.size();
    }
    void write(std::int64_t, Outbox& outbox) override {
        OutsideAnswer answer;
        while (outbox.nextAnswer(answer)) {
            answers.push_back({answer.sequence, answer.outcome});
            whys.push_back(answer.why);
        }
    }
    void close() override {}

    std::shared_ptr<const Structure> structure;
    std::vector<OutsideCommand> commands;
    std::deque<std::vector<std::uint64_t>> records;
    std::vector<Answered> answers;
    std::vector<EventText> whys;
    bool lose = false;

private:
    std::size_t read_ = 0;
};

struct RouterOrder : testing::Test {
    explicit RouterOrder(bool controlRequired = false)
        : rig{"rig", {.outsideCommands = 8, .controlRequired = controlRequired}} {
        rig.add(network);
        rig.make();
        begun.reserve(1000);
        for (Hand* hand : {&worker, &other}) {
            const auto amount = hand->argument<double>("add", "amount");
            hand->on("add", [this, amount](Call& call) {
                begun.push_back(static_cast<int>(call[amount]));
                return Outcome::Done;
            });
            hand->on("watch", [this](Call&) { return begun.push_back(0), Outcome::Running; });
        }
        worker.run = [this] {
            const auto taken = rig.agent->takeLifeCycle(worker.index(), rig.agent->thread(0));
            if (taken == LifeCycle::Startup) begun.push_back(-1);
            if (taken == LifeCycle::Shutdown) begun.push_back(-2);
        };
        rig.start();
        for (Hand* hand : {&worker, &other}) rig.setState(*hand, State::Active);
    }
    void send(const Sent& sent) { network.send(sent, rig.tick.cycle); }
    // Cycles, and no call of the router allocates.
    void step(int cycles = 1) {
        for (int i = 0; i < cycles; ++i) {
            const std::uint64_t before = toolkit::test::allocationCount();
            rig.begin();
            const std::uint64_t tasks = toolkit::test::allocationCount();
            rig.runTasks();
            const std::uint64_t after = toolkit::test::allocationCount();
            rig.end();
            ASSERT_EQ(toolkit::test::allocationCount() - after + tasks - before, 0U);
        }
    }
    Outcome outcomeOf(std::uint64_t number) const {
        const auto found = std::ranges::find(network.answers, number, &Answered::number);
        return found != network.answers.end() ? found->outcome : Outcome::None;
    }
    std::vector<int> takeBegun() { return std::exchange(begun, {}); }

    PreparedInterface network;
    AgentRig rig;
    Hand& worker = rig.hand("/worker");
    Hand& other = rig.hand("/other");
    std::vector<int> begun;  // numbers; 0: a long one, -1: startup, -2: shutdown
};

}  // namespace cortex::test
