// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/loopback.hpp"

#include "cortex/core/error.hpp"

#include "agent/loopback_node.hpp"
#include "tables/lookup.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace cortex {

struct LoopbackHub::Implementation {
    struct Posted {
        std::string agent;
        std::uint64_t sequence = 0;
    };
    struct Carried {
        AgentCall call;
        std::uint64_t number = 0;  // that post() gave
        bool running = false;
    };
    struct Tool {
        std::map<std::string, CommandClient> clients;  // by agent
        std::map<std::uint64_t, Posted> posted;        // by number handed out
        std::vector<Carried> carried;                  // of an agent, which sends as tools do
        std::uint64_t next = 1;
        bool lost = false;
    };

    void join(const std::shared_ptr<LoopbackAgent>& agent);
    void leave(LoopbackAgent& agent);
    void takeAnswers(LoopbackAgent& agent);
    LoopbackAgent* find(const std::string& agent) const;
    LoopbackAgent& ownerOf(std::string_view path) const;
    std::uint64_t post(const std::string& sender, std::string_view path, std::string_view command,
                       const ProgramInterface::Arguments& arguments, std::int64_t budgetCycles);
    bool poll(Tool& tool, std::uint64_t number, CallResult& result);
    void postCalls(LoopbackAgent& agent);
    void answerCalls(LoopbackAgent& agent);

    std::mutex mutex;                                    // guards all but what loops use
    std::vector<std::shared_ptr<LoopbackAgent>> agents;  // the older claim stands first
    std::map<std::string, Tool> tools;
};

namespace {

constexpr std::int64_t callBudget = 1000;  // cycles

// One agent's end: joins the hub when the agent starts, leaves it when it stops.
class LoopbackInterface final : public CommunicationInterface {
public:
    explicit LoopbackInterface(std::shared_ptr<LoopbackHub::Implementation> hub)
        : hub_{std::move(hub)} {}
    ~LoopbackInterface() override {
        if (agent_ != nullptr) close();
    }

    void announce(const AgentAccess& access) override {
        agent_ = std::make_shared<LoopbackAgent>(access);
        hub_->join(agent_);
    }
    void read(Inbox& inbox) override { agent_->read(inbox); }
    void write(std::int64_t, Outbox& outbox) override { agent_->write(outbox); }
    void close() override { hub_->leave(*agent_); }

private:
    std::shared_ptr<LoopbackHub::Implementation> hub_;
    std::shared_ptr<LoopbackAgent> agent_;
};

}  // namespace

void LoopbackHub::Implementation::join(const std::shared_ptr<LoopbackAgent>& agent) {
    const std::lock_guard lock{mutex};
    for (const auto& other : agents) {
        agent->bind(other);
        other->bind(agent);
    }
    agents.push_back(agent);
}

void LoopbackHub::Implementation::leave(LoopbackAgent& agent) {
    {
        const std::lock_guard lock{mutex};
        if (std::erase_if(agents, [&](const auto& each) { return each.get() == &agent; }) == 0)
            return;
        takeAnswers(agent);
        for (auto& [name, tool] : tools) {
            const auto client = tool.clients.find(agent.name());
            if (client != tool.clients.end()) client->second.loseAll("its agent stopped");
        }
    }
    agent.close();
}

void LoopbackHub::Implementation::takeAnswers(LoopbackAgent& agent) {
    CommandPipe& pipe = agent.pipe();
    for (; const OutsideAnswer* answer = pipe.answer(); pipe.popAnswer()) {
        const auto tool = tools.find(std::string{answer->sender.nameText()});
        if (tool == tools.end()) continue;
        const auto client = tool->second.clients.find(agent.name());
        if (client != tool->second.clients.end()) client->second.take(*answer, pipe);
    }
}

LoopbackAgent* LoopbackHub::Implementation::find(const std::string& agent) const {
    const auto found =
        std::ranges::find(agents, agent, [](const auto& each) { return each->name(); });
    return found != agents.end() ? found->get() : nullptr;
}

LoopbackAgent& LoopbackHub::Implementation::ownerOf(std::string_view path) const {
    std::vector<std::string> valid;
    for (const auto& agent : agents) {
        if (agent->owns(path)) return *agent;
        for (const SimplexInfo& info : agent->pipe().structure().simplexes) {
            if (!info.remote) valid.push_back(info.path);
        }
    }
    throwUnknown("no agent has " + std::string{path}, path, valid);
}

LoopbackHub::LoopbackHub() : implementation_{std::make_shared<Implementation>()} {}
LoopbackHub::~LoopbackHub() = default;

std::unique_ptr<CommunicationInterface> LoopbackHub::makeInterface() {
    return std::make_unique<LoopbackInterface>(implementation_);
}

void LoopbackHub::setConnected(const std::string& agent, bool connected) {
    const std::lock_guard lock{implementation_->mutex};
    if (LoopbackAgent* found = implementation_->find(agent)) {
        found->setConnected(connected);
        const std::string why = "its agent is not heard; it may have run";
        for (auto& [name, tool] : implementation_->tools) {
            const auto client = tool.clients.find(agent);
            if (!connected && client != tool.clients.end()) client->second.loseAll(why);
        }
    }
    const auto tool = implementation_->tools.find(agent);
    if (tool == implementation_->tools.end()) return;
    tool->second.lost = !connected;
    for (const auto& each : implementation_->agents) {
        const auto client = tool->second.clients.find(each->name());
        if (!connected && client != tool->second.clients.end()) {
            each->loseSender(client->second.sender());
        }
    }
}

std::uint64_t LoopbackHub::Implementation::post(const std::string& sender, std::string_view path,
                                                std::string_view command,
                                                const ProgramInterface::Arguments& arguments,
                                                std::int64_t budgetCycles) {
    LoopbackAgent& agent = ownerOf(path);
    takeAnswers(agent);
    Tool& tool = tools[sender];
    if (tool.lost) throw Error(sender + " is cut from the network: join it first");
    if (!agent.connected()) throw Error("agent " + agent.name() + " is not heard");
    auto [client, added] = tool.clients.try_emplace(agent.name(), makeSender(sender));
    const std::uint64_t sequence = client->second.post(agent.pipe(), path, command, arguments,
                                                       agent.pipe().validFor(budgetCycles));
    tool.posted[tool.next] = {agent.name(), sequence};
    return tool.next++;
}

bool LoopbackHub::Implementation::poll(Tool& tool, std::uint64_t number, CallResult& result) {
    const auto posted = tool.posted.find(number);
    if (posted == tool.posted.end()) return false;
    if (LoopbackAgent* agent = find(posted->second.agent)) takeAnswers(*agent);
    CommandClient& client = tool.clients.at(posted->second.agent);
    if (!client.poll(posted->second.sequence, result)) return false;
    tool.posted.erase(posted);
    return true;
}

// What cannot be sent surely does not run.
void LoopbackHub::Implementation::postCalls(LoopbackAgent& agent) {
    AgentCallPipe& calls = agent.calls();
    for (; const AgentCall* call = calls.front(); calls.pop()) {
        try {
            if (!agent.connected()) throw Error("agent " + agent.name() + " is cut off");
            const std::uint64_t number =
                post(agent.name(), calls.pathOf(*call), calls.commandOf(*call),
                     calls.argumentsOf(*call), callBudget);
            tools[agent.name()].carried.push_back({*call, number});
        } catch (const Error& error) {
            CallResult result;
            result.outcome = Outcome::Expired;
            result.why = error.what();
            calls.answer(*call, result);
        }
    }
}

void LoopbackHub::Implementation::answerCalls(LoopbackAgent& agent) {
    Tool& tool = tools[agent.name()];
    std::erase_if(tool.carried, [&](Carried& each) {
        CallResult result;
        if (poll(tool, each.number, result)) {
            agent.calls().answer(each.call, result);
            return true;
        }
        const Posted& posted = tool.posted.at(each.number);
        const bool running = tool.clients.at(posted.agent).running(posted.sequence);
        if (running && !std::exchange(each.running, true)) {
            result.outcome = Outcome::Running;
            agent.calls().answer(each.call, result);
        }
        return false;
    });
}

void LoopbackHub::carry() {
    const std::lock_guard lock{implementation_->mutex};
    for (const auto& agent : implementation_->agents) {
        implementation_->postCalls(*agent);
        implementation_->answerCalls(*agent);
    }
}

std::uint64_t LoopbackHub::post(const std::string& sender, std::string_view path,
                                std::string_view command,
                                const ProgramInterface::Arguments& arguments,
                                std::int64_t budgetCycles) {
    const std::lock_guard lock{implementation_->mutex};
    return implementation_->post(sender, path, command, arguments, budgetCycles);
}

bool LoopbackHub::poll(const std::string& sender, std::uint64_t sequence, CallResult& result) {
    const std::lock_guard lock{implementation_->mutex};
    const auto tool = implementation_->tools.find(sender);
    return tool != implementation_->tools.end() &&
           implementation_->poll(tool->second, sequence, result);
}

}  // namespace cortex
