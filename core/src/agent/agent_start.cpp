// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/event_memory.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/system_findings.hpp"
#include "cortex/core/validation.hpp"

#include "agent/router.hpp"
#include "commands/command_port.hpp"
#include "commands/lane_block.hpp"
#include "commands/sender_state.hpp"
#include "tables/lookup.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace cortex {
namespace {

std::int64_t utcMicroseconds() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

bool isLifeCycle(const CommandSender::State& handle) {
    return lifeCycleCommand(handle.table->entries[handle.command].name) != LifeCycle::None;
}

bool isShutdown(const CommandSender::State& handle) {
    return lifeCycleCommand(handle.table->entries[handle.command].name) == LifeCycle::Shutdown;
}

// The places of life-cycle commands are theirs alone, and that of `shutdown` its own: one that is
// full of others does not keep a simplex from being shut down.
std::uint32_t keepPlaces(std::span<CommandSender::State* const> handles) {
    constexpr std::uint32_t most = 3;  // one for each life-cycle command
    std::uint32_t lifeCycle = 0;
    bool hasShutdown = false;
    for (const CommandSender::State* handle : handles) {
        if (isLifeCycle(*handle)) lifeCycle += handle->capacity;
        hasShutdown = hasShutdown || isShutdown(*handle);
    }
    const std::uint32_t kept = std::min(lifeCycle, most);
    for (CommandSender::State* handle : handles) {
        if (!isLifeCycle(*handle)) continue;
        const std::uint32_t others = hasShutdown && !isShutdown(*handle) ? 1 : 0;
        handle->beyond = (kept - others) & 3U;
    }
    return kept;
}

std::vector<std::string> namesOf(const CommandTable& table) {
    std::vector<std::string> names;
    for (const auto& entry : table.entries) names.emplace_back(entry.name);
    return names;
}

// Life-cycle commands alone need no port.
bool bypassesMailbox(const CommandTable& table) {
    return std::ranges::all_of(table.entries, [](const CommandTable::Entry& entry) {
        return lifeCycleCommand(entry.name) != LifeCycle::None;
    });
}

[[noreturn]] void refuse(Finding finding) {
    Report report;
    report.add(std::move(finding));
    throw ModelError(std::move(report));
}

}  // namespace

AgentRuntime::AgentRuntime(std::string name, SimplexTree& tree, AgentOptions options)
    : name_{std::move(name)}, tree_{tree}, options_{std::move(options)} {
    addAgentSimplex();
    tree_.createRelated();
    checkModel();
    structure_ = makeStructure(name_, tree_);
    structure_->epoch = options_.epoch > 0 ? options_.epoch : utcMicroseconds();
    tables_ = std::make_unique<Tables>(structure_);
    // And the one that an interface has taken out to send it.
    const std::uint32_t kept = options_.imageKeepers * (imagesToKeep(tables_->arena().size()) + 1);
    images_ = std::make_unique<ImagePool>(*tables_, options_.imageReaders + kept);
    threads_.resize(std::max(options_.loopThreads, 1U));
    events_ = std::make_unique<EventLog>(structure_, threadCount(), options_.eventCapacity);
    keepEvents();
    for (std::uint32_t i = 0; i < threadCount(); ++i) {
        threads_[i].events = &events_->ring(i);
        threads_[i].latencyCounts.resize(latencyBuckets);
    }
    bindSimplexes();
    tree_.agent_ = name_;
}

AgentRuntime::~AgentRuntime() {
    stop();
    tree_.agent_.clear();
    for (Simplex* simplex : simplexes_) {
        if (simplex != nullptr) simplex->runtime_ = nullptr;
    }
    for (const auto& sender : senders_) sender->lane = nullptr;
}

void AgentRuntime::keepEvents() {
    if (!options_.memory) {
        options_.memory =
            std::make_shared<EventMemory>(EventMemory::usualEntries, utcMicroseconds() * 1000);
    }
    events_->addSink(
        [memory = options_.memory](const Event& event, const Structure& structure) {
            memory->take(event, structure);
        },
        EventLog::Repeats::Folded);
}

void AgentRuntime::addAgentSimplex() {
    const std::string path = "/" + name_;
    const std::string wrong = SimplexTree::pathError(path);
    if (!wrong.empty()) throw Error("agent name '" + name_ + "': " + wrong);
    if (tree_.find(path) == nullptr) {
        if (tree_.types().find("Agent") == nullptr) {
            refuse({Severity::Error, path, finding::agentType, Place{},
                    "the ontology has no type Agent", "include base.xml"});
        }
        tree_.add(path, "Agent");
    }
    const Simplex& agent = tree_.at(path);
    if (!agent.type().isA("Agent")) {
        refuse({Severity::Error, path, finding::agentType, agent.place(),
                "this path is the agent's own, but its type is " + agent.type().name,
                "give it the type Agent or Cluster, or give the agent another name"});
    }
}

void AgentRuntime::checkModel() {
    report_ = validate(tree_, options_.extent);
    if (!report_.ok()) throw ModelError(std::move(report_));
}

void AgentRuntime::bindSimplexes() {
    const auto count = static_cast<std::uint32_t>(structure_->simplexes.size());
    std::map<const TypeLayout*, const CommandTable*> tables;
    simplexes_.resize(count);
    ports_.resize(count);
    present_.ranks.resize(count);
    tableOf_.reserve(count);
    while (firstRemote_ < count && !structure_->simplexes[firstRemote_].remote) ++firstRemote_;
    ownerPeriods_.assign(count - firstRemote_, options_.period);
    linkLosses_.assign(count - firstRemote_, 0);
    everOffered_.assign(count - firstRemote_, false);
    everLinked_.assign(count - firstRemote_, false);
    linked_ = std::make_unique<std::atomic<bool>[]>(count - firstRemote_);
    calls_ = std::make_unique<std::atomic<std::uint8_t>[]>(count);
    callsLater_ = std::make_unique<std::atomic<std::uint8_t>[]>(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const SimplexInfo& info = structure_->simplexes[i];
        present_.ranks[i] = i;
        const CommandTable*& table = tables[info.layout];
        if (table == nullptr) {
            commandTables_.push_back(
                std::make_unique<CommandTable>(commandTable(*info.layout->type)));
            table = commandTables_.back().get();
        }
        tableOf_.push_back(table);
        if (info.remote) continue;
        simplexes_[i] = &tree_.at(info.path);
        simplexes_[i]->index_ = i;
        simplexes_[i]->runtime_ = this;
        if (!bypassesMailbox(*table)) portOf(i);
    }
    agentSimplex_ = structure_->find("/" + name_);
    portOf(agentSimplex_);
}

CommandPort& AgentRuntime::portOf(std::uint32_t simplex) {
    auto& port = ports_[simplex];
    if (port == nullptr) {
        const PortAccess access{*structure_, *tables_, present_, threads_[0], calls_[simplex]};
        port = std::make_unique<CommandPort>(access, simplex, *tableOf_[simplex]);
    }
    return *port;
}

void AgentRuntime::addInterface(CommunicationInterface& interface) {
    interfaces_.push_back(&interface);
}

void AgentRuntime::setCanonicalOrder(std::span<const std::uint32_t> order) {
    auto rank = static_cast<std::uint32_t>(order.size());
    for (std::uint32_t& each : present_.ranks) each = rank++;
    for (std::uint32_t i = 0; i < order.size(); ++i) present_.ranks[order[i]] = i;
}

void AgentRuntime::registerHandler(std::uint32_t simplex, std::string_view command,
                                   Handler handler) {
    const CommandTable& table = commands(simplex);
    const std::uint32_t index = table.find(command);
    if (index == CommandTable::none || table.entries[index].command == nullptr) {
        throwUnknown(structure_->simplexes[simplex].path + ": its type has no command '" +
                         std::string{command} + "' to handle",
                     command, namesOf(table));
    }
    portOf(simplex).setHandler(index, handler);
}

void AgentRuntime::registerSettingsHooks(std::uint32_t simplex, const SettingsHooks& hooks) {
    portOf(simplex).setHooks(hooks);
}

std::span<const SettableItem> AgentRuntime::settables(std::uint32_t simplex) const {
    if (ports_[simplex] == nullptr) return {};
    return ports_[simplex]->settables();
}

CommandSender AgentRuntime::makeSender(std::uint32_t edge, std::string_view command,
                                       std::uint32_t capacity) {
    const SimplexInfo& target = structure_->simplexes[structure_->edges[edge].target];
    const CommandTable& table = commands(structure_->edges[edge].target);
    const std::uint32_t index = table.find(command);
    const std::string what = target.path + ": command '" + std::string{command} + "'";
    if (started_) throw Error(what + ": get its sender in populate()");
    if (index == CommandTable::none) throwUnknown(what + " is unknown", command, namesOf(table));
    if (!target.remote && target.layout->type->active() && target.path != "/" + name_ &&
        lifeCycleCommand(command) != LifeCycle::None) {
        throw Error(what + " bypasses mailboxes: use lifeCycle()");
    }
    if (table.entries[index].request.size > Lane::mostRequest) {
        throw Error(what +
                    " has more than 512 KiB of parameters, too many for a relationship; "
                    "send it from outside, or let fewer items be settable");
    }
    auto state = std::make_shared<CommandSender::State>(table, index, edge, std::max(capacity, 1U));
    senders_.push_back(state);
    return CommandSender{std::move(state)};
}

// One lane per relationship that commands go along, in canonical order of senders.
void AgentRuntime::makeLanes() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<CommandSender::State*>> lanes;
    for (const auto& sender : senders_) {
        lanes[{rank(structure_->edges[sender->edge].owner), sender->edge}].push_back(sender.get());
    }
    std::vector<LaneBlock::Plan> plans;
    for (auto& [key, handles] : lanes) {
        const Edge& edge = structure_->edges[key.second];
        const bool remote = structure_->simplexes[edge.target].remote;
        // To another agent life-cycle commands go along lanes, too, and are answered twice.
        const bool hasLifeCycle = remote && std::ranges::any_of(handles, [](const auto* handle) {
                                      return isLifeCycle(*handle);
                                  });
        Lane::Shape shape{edge.owner,
                          edge.target,
                          0,
                          0,
                          0,
                          edge.delayed && !remote,
                          commands(edge.target).hasLong || hasLifeCycle};
        for (std::uint16_t i = 0; CommandSender::State * handle : handles) {
            handle->handle = i++;
            shape.capacity += handle->capacity;
            shape.requestSize = std::max(shape.requestSize, handle->requestSize());
            shape.responseSize = std::max(shape.responseSize, handle->responseSize());
        }
        if (remote) shape.running = shape.capacity;
        shape.kept = keepPlaces(handles);
        plans.push_back({shape, std::move(handles)});
    }
    lanes_ = std::make_unique<LaneBlock>(std::move(plans));
    for (Lane* lane : lanes_->lanes()) {
        CommandPort& sender = portOf(lane->shape().sender);
        lane->setSender(sender);
        sender.addSending(*lane);
        if (structure_->simplexes[lane->shape().receiver].remote)
            toAgents_.push_back(lane);
        else
            portOf(lane->shape().receiver).addReceiving(*lane);
    }
}

std::uint32_t AgentRuntime::callsToAgents() const {
    std::uint32_t calls = 0;
    for (const Lane* lane : toAgents_) calls += lane->shape().underWay();
    return calls;
}

// The commands of a simplex without a task are executed at the start of the cycle; first those to
// the agent itself, because they concern all others.
void AgentRuntime::findTaskless() {
    for (std::uint32_t i = 0; i < ports_.size(); ++i) {
        if (ports_[i] == nullptr) continue;
        const bool hasTask = structure_->simplexes[i].role == Role::Active && i != agentSimplex_;
        if (!hasTask && (ports_[i]->hasLanes() || i == agentSimplex_)) taskless_.push_back(i);
    }
    std::ranges::sort(taskless_, {}, [this](std::uint32_t i) {
        return std::pair{i != agentSimplex_, present_.ranks[i]};
    });
}

void AgentRuntime::start() {
    if (started_) throw Error("agent " + name_ + " is started already");
    tables_->giveUpUnusedLatches();
    if (lanes_ == nullptr) {  // otherwise an interface refused an earlier start()
        makeLanes();
        findTaskless();
    }
    router_ = std::make_unique<Router>(*this, toAgents_);
    const AgentAccess access{.structure = structure_,
                             .images = images_.get(),
                             .events = events_.get(),
                             .memory = options_.memory.get(),
                             .period = options_.period,
                             .calls = callsToAgents(),
                             .realTime = options_.realTime,
                             .standstill = &standstill_,
                             .pace = &pace_};
    std::size_t announced = 0;
    try {
        for (; announced < interfaces_.size(); ++announced)
            interfaces_[announced]->announce(access);
    } catch (...) {  // the one that failed and those after it know no agent
        while (announced > 0) interfaces_[--announced]->close();
        throw;
    }
    started_ = true;
    images_->publish(0, 0, utcMicroseconds() * 1000);
    events_->start();
}

}  // namespace cortex
