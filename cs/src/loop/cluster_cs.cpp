// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/cluster_cs.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/sending_checks.hpp"
#include "cortex/core/service_threads.hpp"
#include "cortex/core/system_findings.hpp"
#include "cortex/core/validation.hpp"
#include "cortex/cs/testing.hpp"

#include "loop/cluster_loop.hpp"
#include "loop/given_values.hpp"
#include "loop/simplex_classes.hpp"
#include "loop/start_order.hpp"
#include "loop/two_managers.hpp"
#include "tasks/crash_report.hpp"
#include "tasks/io_threads.hpp"
#include "tasks/unbound_handle.hpp"
#include "threads/realtime_thread.hpp"
#include "threads/scheduler.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace cortex::cs {

struct ClusterCS::Implementation {
    std::string name;
    ClusterOptions options;
    TestOptions test;
    SimplexTree* tree = nullptr;
    const ClassRegistry* registry = nullptr;
    std::unique_ptr<TriggerSource> trigger;
    std::vector<std::unique_ptr<CommunicationInterface>> interfaces;
    std::vector<std::function<void(const Heartbeat&)>> heartbeats;
    std::vector<std::pair<EventLog::Sink, EventLog::Repeats>> sinks;
    std::function<void()> beforeFirstCycle;
    ProgramInterface program;
    std::unique_ptr<AgentRuntime> agent;
    std::unique_ptr<ClusterLoop> loop;
    IoThreads ioThreads;
    std::vector<std::string> notShutDown;

    std::vector<SimplexCS*> activeInOrder(std::span<const std::uint32_t> order) const;
    TaskGraph graph() const;
    StartOrder startOrder(const TaskGraph& graph, std::span<const std::uint32_t> order) const;
    void populate(std::span<SimplexCS* const> simplexes) const;
    void joinSettings(SimplexCS& simplex, Report& report) const;
    std::vector<std::uint32_t> managersOf(std::span<SimplexCS* const> simplexes) const;
    Report checkNetwork() const;
    void warnOf(const Report& report) const;
    void endIoThreads();
    [[noreturn]] void endProcess(const std::string& why) const;
};

namespace {

std::uint32_t threadsFor(const ClusterOptions& options, std::vector<std::string>& report) {
    const std::uint32_t threads =
        clampThreads(options.threads, options.priority, options.cpus, report);
    return options.acrossCaches ? threads : threadsWithCommonCache(threads, options.cpus, report);
}

// These wait for a loop, which waits for the hook that calls them.
void refuseInHooks(std::string_view function, std::string_view remedy) {
    if (!isLoopThread()) return;
    throw Error(std::string{function} +
                " was called in a hook or on another thread of the loop: " + std::string{remedy});
}

[[noreturn]] void refuse(Report report) { throw ModelError(std::move(report)); }

}  // namespace

ClusterCS::ClusterCS(std::string name, ClusterOptions options)
    : implementation_{std::make_unique<Implementation>()} {
    const std::string wrong = SimplexTree::pathError("/" + name);
    if (!wrong.empty()) throw Error("the cluster's name '" + name + "': " + wrong);
    if (options.threads == 0) throw Error("cluster " + name + " needs at least 1 thread");
    implementation_->name = std::move(name);
    implementation_->options = std::move(options);
}

ClusterCS::~ClusterCS() {
    stop();
    const BoundedStep step{"the destructors of cluster " + implementation_->name};
    implementation_.reset();
}

void ClusterCS::addSimplexTree(SimplexTree& tree) {
    if (implementation_->tree != nullptr) {
        throw Error("cluster " + implementation_->name + " has a tree already; add to that one");
    }
    implementation_->tree = &tree;
}

void ClusterCS::useClasses(const ClassRegistry& registry) { implementation_->registry = &registry; }

void ClusterCS::setTrigger(std::unique_ptr<TriggerSource> source) {
    implementation_->trigger = std::move(source);
}

void ClusterCS::adoptInterface(std::unique_ptr<CommunicationInterface> interface) {
    implementation_->interfaces.push_back(std::move(interface));
}

void ClusterCS::addHeartbeat(std::function<void(const Heartbeat&)> function) {
    implementation_->heartbeats.push_back(std::move(function));
}

void ClusterCS::addEventSink(EventLog::Sink sink, EventLog::Repeats repeats) {
    implementation_->sinks.emplace_back(std::move(sink), repeats);
}

void ClusterCS::beforeFirstCycle(std::function<void()> function) {
    implementation_->beforeFirstCycle = std::move(function);
}

TaskGraph ClusterCS::Implementation::graph() const {
    const Structure& structure = agent->structure();
    TaskGraph graph;
    graph.nodes.reserve(structure.simplexes.size());
    for (const SimplexInfo& info : structure.simplexes) {
        const bool arbitrated = info.writers.size() > 1;
        graph.nodes.push_back({info.path, hasTask(info) || arbitrated, info.every, 0});
    }
    for (const Edge& edge : structure.edges) {
        const SimplexInfo& target = structure.simplexes[edge.target];
        // What several write is put together after the last of them, even if it is read later.
        const bool joins = edge.rule->direction == Direction::Output && target.writers.size() > 1;
        if ((edge.delayed && !joins) || target.remote) continue;
        if (edge.rule->direction == Direction::Output) {
            graph.edges.emplace_back(edge.owner, edge.target);
        } else if (!target.delayedOutput) {
            graph.edges.emplace_back(edge.target, edge.owner);
        }
    }
    return graph;
}

std::vector<SimplexCS*> ClusterCS::Implementation::activeInOrder(
    std::span<const std::uint32_t> order) const {
    std::vector<SimplexCS*> simplexes;
    for (const std::uint32_t index : order) {
        if (!hasTask(agent->structure().simplexes[index])) continue;
        simplexes.push_back(&static_cast<SimplexCS&>(agent->simplex(index)));
    }
    return simplexes;
}

StartOrder ClusterCS::Implementation::startOrder(const TaskGraph& graph,
                                                 std::span<const std::uint32_t> order) const {
    std::vector<SimplexCS*> actives(graph.nodes.size());
    for (SimplexCS* each : activeInOrder(order)) actives[each->index()] = each;
    return cs::startOrder(graph, order, actives);
}

// The simplex judges each `set`, and now the values that it begins with.
void ClusterCS::Implementation::joinSettings(SimplexCS& simplex, Report& report) const {
    const std::span<const SettableItem> items = agent->settables(simplex.index());
    if (items.empty()) return;
    agent->registerSettingsHooks(
        simplex.index(), {&simplex,
                          [](void* self, ProposedSettings& proposed) {
                              static_cast<SimplexCS*>(self)->settingsProposed(proposed);
                          },
                          [](void* self) { static_cast<SimplexCS*>(self)->settingsChanged(); }});
    ProposedSettings given{items, nullptr};
    simplex.settingsProposed(given);
    if (!given.refusal()) return;
    report.error(
        simplex.path(), finding::settingsRefused, simplex.place(),
        "it refuses the values that it begins with: " + std::string{given.refusal()->view()},
        "give it other values by <set> in the system file, or other defaults");
}

void ClusterCS::Implementation::populate(std::span<SimplexCS* const> simplexes) const {
    Report report;
    const GivenValues given{*agent};
    for (SimplexCS* simplex : simplexes) {
        const BoundedStep step{"populate() of " + simplex->path() + " (" + simplex->type().name +
                               ")"};
        try {
            simplex->populate();
            given.check(simplex->index(), report);
            joinSettings(*simplex, report);
        } catch (const UnboundHandle& unbound) {
            report.error(
                simplex->path(), finding::populate, simplex->place(),
                "handle " + unbound.handle() +
                    std::string{neighboursOf(unbound, *simplex, agent->tables()).view()} +
                    " is used before it is bound: = with a value or another handle copies a value",
                "bind it first: what data<…>(\"item\"), input(…).data<…>(\"item\") and their "
                "like return is bound by =");
            continue;
        } catch (const std::exception& error) {
            const std::string path = simplex->path() + ": ";
            std::string_view what = error.what();
            if (what.starts_with(path)) what.remove_prefix(path.size());
            report.error(simplex->path(), finding::populate, simplex->place(), std::string{what});
            continue;
        } catch (...) {
            report.error(simplex->path(), finding::populate, simplex->place(),
                         "populate() threw what is no std::exception",
                         "throw cortex::Error, or another std::exception, with what is wrong");
            continue;
        }
        agent->checkCommands(simplex->index(), report);
    }
    if (!report.ok()) refuse(std::move(report));
}

std::vector<std::uint32_t> ClusterCS::Implementation::managersOf(
    std::span<SimplexCS* const> simplexes) const {
    std::vector<std::uint32_t> managers(agent->structure().simplexes.size(), noSimplex);
    for (const SimplexCS* each : simplexes) managers[each->index()] = each->manager_;
    return managers;
}

// Sizes count where others are to read them.
Report ClusterCS::Implementation::checkNetwork() const {
    return interfaces.empty() ? Report{} : checkSending(*tree, agent->structure());
}

void ClusterCS::Implementation::warnOf(const Report& report) const {
    for (const Finding& finding : report.findings) {
        EventText text{finding.message};
        const std::string place = finding.place.text();
        if (!place.empty()) text << " [" << place << "]";
        Event event;
        event.severity = Severity::Warning;
        event.simplex = agent->structure().find(finding.path);
        event.text = text;
        agent->events().postOutside(event);
    }
}

// A thread cannot be ended in an orderly way while a user's code holds it.
void ClusterCS::Implementation::endProcess(const std::string& why) const {
    std::fprintf(stderr, "cluster %s does not stop: %s; ending the process\n", name.c_str(),
                 why.c_str());
    std::_Exit(3);
}

void ClusterCS::Implementation::endIoThreads() {
    if (const std::string hung = ioThreads.end(); !hung.empty()) endProcess(hung);
}

void ClusterCS::start() {
    refuseInHooks("start()", "clusters are started by the program");
    if (implementation_->loop)
        throw Error("cluster " + implementation_->name + " was started before");
    const auto undo = [this] {
        implementation_->loop.reset();
        implementation_->endIoThreads();
        implementation_->agent.reset();
    };
    try {
        startAll();
    } catch (const std::system_error& error) {
        undo();
        const std::string refused = threadRefused(error);
        if (refused.empty()) throw;
        throw Error("cluster " + implementation_->name + ": " + refused);
    } catch (...) {
        undo();
        throw;
    }
}

void ClusterCS::startAll() {
    Implementation& self = *implementation_;
    if (self.tree == nullptr) throw Error("give cluster " + self.name + " a tree: addSimplexTree");
    if (!self.trigger) throw Error("give cluster " + self.name + " a trigger: setTriggerSource");
    const std::string path = "/" + self.name;
    if (self.tree->types().find("Cluster") == nullptr) {
        Report report;
        report.error(path, finding::noClusterType, {}, "the ontology has no type Cluster",
                     "include base.xml: <ontology file=\"base.xml\"/>");
        refuse(std::move(report));
    }
    if (self.tree->find(path) == nullptr) self.tree->add(path, "Cluster");
    const Simplex& cluster = self.tree->at(path);
    if (!cluster.type().isA("Cluster")) {
        Report report;
        report.error(path, finding::agentType, cluster.place(),
                     "a cluster's own simplex is a Cluster, here it is a " + cluster.type().name,
                     "leave it out, or write type=\"Cluster\"");
        refuse(std::move(report));
    }
    self.tree->createRelated(self.registry);

    std::vector<std::string> realtimeReport;
    const std::uint32_t threads =
        self.test.forceThreads ? self.options.threads : threadsFor(self.options, realtimeReport);
    AgentOptions options;
    options.imageReaders = self.options.imageReaders + 1;  // one for the look at task times
    options.imageKeepers = static_cast<std::uint32_t>(self.interfaces.size());
    options.loopThreads = threads;
    options.controlRequired = self.options.controlRequired;
    options.period = self.trigger->period();
    options.epoch = self.options.epoch;
    options.files = self.options.files;
    options.memory = self.options.memory;
    options.realTime = self.trigger->realTime();
    options.devices = self.options.devices;
    options.extent = self.test.extent;
    self.agent = std::make_unique<AgentRuntime>(self.name, *self.tree, options);
    if (Report report = missingClasses(*self.agent, self.registry); !report.ok())
        refuse(std::move(report));
    const Report sending = self.checkNetwork();
    if (!sending.ok()) refuse(sending);
    const TaskGraph graph = self.graph();
    const std::vector<std::uint32_t> order = canonicalOrder(graph);
    self.agent->setCanonicalOrder(order);
    const std::vector<SimplexCS*> simplexes = self.activeInOrder(order);
    self.populate(simplexes);
    if (options.extent == Extent::Whole) {
        if (Report report = twoManagers(*self.agent, self.managersOf(simplexes)); !report.ok())
            refuse(std::move(report));
    }
    Schedule schedule =
        makeSchedule(graph, {threads, self.test.chunkSize, {}, self.test.forceThreads});
    self.agent->addInterface(self.program);
    for (const auto& interface : self.interfaces) self.agent->addInterface(*interface);
    for (const auto& [sink, repeats] : self.sinks) self.agent->events().addSink(sink, repeats);
    self.loop = std::make_unique<ClusterLoop>(*self.agent, *self.trigger, self.options,
                                              std::move(schedule), self.startOrder(graph, order),
                                              self.heartbeats, std::move(realtimeReport));
    Report inVain;
    GivenValues{*self.agent}.checkDemands(inVain);
    if (!inVain.ok()) refuse(std::move(inVain));
    self.loop->testWith(self.test);
    self.loop->rescheduleBy([&self, threads](std::span<const double> costs) {
        return makeSchedule(self.graph(), {threads, self.test.chunkSize, costs, false});
    });
    {
        const BoundedStep step{"joining the network as /" + self.name};
        self.agent->start();
    }
    if (self.beforeFirstCycle) self.beforeFirstCycle();
    if (self.trigger->realTime()) {
        self.agent->refuseWriters();  // nobody knows when such a loop is between two cycles
    }
    self.loop->start();
    if (self.options.devices) self.ioThreads.begin(simplexes);
    self.warnOf(self.agent->warnings());
    self.warnOf(sending);
    tellInheritedClasses(*self.agent, self.registry);
}

bool ClusterCS::stop() {
    Implementation& self = *implementation_;
    if (!self.loop || !self.loop->joinable()) return self.notShutDown.empty();
    refuseInHooks("stop()", "tell the program to stop, or command the simplexes: shutdown");
    if (const auto hung = self.loop->stop()) self.endProcess(hung->text());
    self.endIoThreads();
    {
        const BoundedStep step{"leaving the network as /" + self.name};
        self.agent->stop();
    }
    self.notShutDown = self.loop->notFollowed();
    return self.notShutDown.empty();
}

const std::vector<std::string>& ClusterCS::notShutDown() const {
    return implementation_->notShutDown;
}

TestOptions& ClusterTesting::optionsOf(ClusterCS& cluster) { return cluster.implementation_->test; }

bool ClusterTesting::offerPlan(ClusterCS& cluster, std::uint32_t threads, std::uint32_t chunkSize) {
    const ClusterCS::Implementation& self = *cluster.implementation_;
    return self.loop->offerPlan(makeSchedule(self.graph(), {threads, chunkSize, {}, true}));
}

bool ClusterCS::running() const {
    return implementation_->loop && implementation_->loop->running();
}

Ended ClusterCS::ended() const {
    return implementation_->loop ? implementation_->loop->ended() : Ended::NotStarted;
}

AgentRuntime& ClusterCS::agent() {
    if (!implementation_->agent) {
        throw Error("cluster " + implementation_->name + " has no tables before start()");
    }
    return *implementation_->agent;
}

Image ClusterCS::image() {
    Image image = agent().images().newest();
    if (!image) throw Error("too many images are held at once; raise ClusterOptions::imageReaders");
    return image;
}

ProgramInterface& ClusterCS::program() { return implementation_->program; }

std::uint64_t ClusterCS::send(std::string_view path, std::string_view command,
                              const ProgramInterface::Arguments& arguments) {
    return program().post(path, command, arguments);
}

CallResult ClusterCS::call(std::string_view path, std::string_view command,
                           const ProgramInterface::Arguments& arguments,
                           std::chrono::milliseconds timeout) {
    refuseInHooks("call()", "in a hook, command a related simplex by a CommandSender");
    return program().call(path, command, arguments, timeout);
}

const std::vector<std::string>& ClusterCS::realtimeReport() const {
    static const std::vector<std::string> none;
    return implementation_->loop ? implementation_->loop->realtimeReport() : none;
}

std::uint32_t ClusterCS::threadsInUse() const {
    return implementation_->loop ? implementation_->loop->threads() : 0;
}

}  // namespace cortex::cs
