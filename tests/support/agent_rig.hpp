// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/program_interface.hpp"

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::test {

TypeModel commandTypes();  // tests/data/command-rules.xml

// An active simplex without a control system: the test runs its step (1) and decides its state.
class Hand : public Simplex {
public:
    using Simplex::argument;
    using Simplex::arrayArgument;
    using Simplex::arrayResult;
    using Simplex::handle;
    using Simplex::input;
    using Simplex::inputs;
    using Simplex::output;
    using Simplex::outputs;
    using Simplex::result;
    using Simplex::Simplex;

    using Function = std::function<Outcome(Call&)>;
    void on(std::string_view command, Function function);  // in populate

    State state = State::Active;
    std::function<void()> run;  // after step (1)

private:
    std::deque<Function> functions_;
};

// An interface played by the test: what read() hands over, and what came back.
class PlayedInterface final : public CommunicationInterface {
public:
    struct Answer {
        std::string sender;
        std::uint64_t sequence;
        Outcome outcome;
        Reason reason;
        std::string why;
        std::int64_t latencyCycles;
        std::vector<std::byte> response;
    };
    void announce(const AgentAccess& agent) override { access = agent; }
    void read(Inbox& inbox) override;
    void write(std::int64_t cycle, Outbox& outbox) override;
    void close() override { closed = true; }

    void atRead(std::function<void(Inbox&)> function) { reads_.push_back(std::move(function)); }
    // A command with its record made of `arguments`; what is left out is good.
    struct Message {
        std::string path, command;
        ProgramInterface::Arguments arguments = {};
        std::string sender = "tool";
        std::uint64_t sequence = 1, answeredBelow = 1;
        std::int64_t epoch = 1, targetEpoch = 0, notAfter = 100'000, until = 0;
        std::string host = {}, onBehalfOf = {};
        std::int32_t sizeError = 0;
    };
    void send(const Message& message);
    void loseSender(const std::string& name, std::int64_t epoch = 1);
    Answer last() const;

    AgentAccess access;
    std::vector<Answer> answers;
    bool closed = false;

private:
    std::vector<std::function<void(Inbox&)>> reads_;
};

// An agent "rig" that the test steps: begin of the cycle, the tasks in canonical order, its end.
class AgentRig {
public:
    explicit AgentRig(std::string name = "rig", AgentOptions options = {});
    AgentRig(TypeModel types, std::string name, AgentOptions options = {});
    ~AgentRig();

    Hand& hand(std::string_view path, std::string_view type = "Worker") {
        return tree.add<Hand>(path, type);
    }
    void make();   // the agent: from here on handles can be got
    void start();  // make() where not done
    void step(int cycles = 1);
    void begin();
    void runTasks();
    void end();
    void add(CommunicationInterface& interface) { interfaces_.push_back(&interface); }
    void setState(Hand& hand, State state);  // with the item, as a control system does

    std::vector<std::string> events();  // "path: text", all so far
    bool hasEvent(std::string_view part);
    template <class T>
    T get(std::string_view path, std::string_view item) {
        return agent->images().newest().get<T>(path, item);
    }

    SimplexTree tree;
    std::unique_ptr<AgentRuntime> agent;
    PlayedInterface outside;
    Tick tick;
    std::vector<std::string> order;  // of the tasks, by path; empty: all by path

private:
    std::string name_;
    AgentOptions options_;
    std::vector<CommunicationInterface*> interfaces_;
    std::mutex mutex_;
    std::vector<std::string> events_;
};

}  // namespace cortex::test
