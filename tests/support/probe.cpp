// SPDX-License-Identifier: Apache-2.0
#include "support/probe.hpp"

#include "cortex/core/agent.hpp"

#include <chrono>

namespace cortex::test {

using namespace std::chrono_literals;

void Probe::populate() {
    amount = argument<double>("add", "amount");
    sum = result<double>("add", "sum");
    on<&Probe::add>("add");
    on<&Probe::poke>("poke");
    for (const char* command : {"work", "watch", "keep"}) {
        if (type().findCommand(command) != nullptr) on<&Probe::work>(command);
    }
    if (onPopulate) onPopulate(*this);
}

void Probe::forgetHooks() {
    onLoopStart = onStandby = onActive = onLoopEnd = nullptr;
    onStartingUp = onShuttingDown = onFault = nullptr;
    onAdd = onPoke = onWork = nullptr;
    onProposed = nullptr;
    onChanged = nullptr;
    onKeep = nullptr;
}

ProbeCluster::ProbeCluster(cs::ClusterOptions options, const std::string& name)
    : tree{TypeModel::load(std::string{CORTEX_SOURCE_DIR} + "/tests/data/cs-rules.xml")},
      cluster{std::make_unique<cs::ClusterCS>(name, std::move(options))} {
    cluster->addSimplexTree(tree);
    trigger = &cluster->setTriggerSource<cs::ManualTrigger>(1ms);
    cluster->addEventSink([this](const Event& event, const Structure& structure) {
        const std::string path = event.simplex < structure.simplexes.size()
                                     ? structure.simplexes[event.simplex].path
                                     : std::string{};
        events_.push_back(path + ": " + std::string{event.text.view()});
    });
}

ProbeCluster::~ProbeCluster() {
    for (const auto& [path, simplex] : tree.simplexes()) {
        if (auto* probe = dynamic_cast<Probe*>(simplex.get())) probe->forgetHooks();
    }
    cluster.reset();
}

void ProbeCluster::start() { cluster->start(); }

CallResult ProbeCluster::call(std::string_view path, std::string_view command,
                              const ProgramInterface::Arguments& arguments) {
    const std::uint64_t sequence = cluster->send(path, command, arguments);
    CallResult result;
    for (int i = 0; i < 100; ++i) {
        step();
        if (cluster->program().poll(sequence, result)) break;
    }
    return result;
}

void ProbeCluster::startup(Probe& probe) {
    cluster->send(probe.path(), "startup");
    for (int i = 0; i < 100 && state(probe.path()) != State::Active; ++i) step();
}

double ProbeCluster::number(std::string_view path, std::string_view item) {
    return cluster->image().get<double>(path, item);
}

std::int64_t ProbeCluster::integer(std::string_view path, std::string_view item) {
    return cluster->image().get<std::int64_t>(path, item);
}

State ProbeCluster::state(std::string_view path) {
    return static_cast<State>(integer(path, "state"));
}

Quality ProbeCluster::quality(std::string_view path) { return cluster->image().quality(path); }

std::vector<std::string> ProbeCluster::events() {
    cluster->agent().events().flush();
    return events_;
}

bool ProbeCluster::hasEvent(std::string_view text) {
    for (const std::string& event : events()) {
        if (event.find(text) != std::string::npos) return true;
    }
    return false;
}

}  // namespace cortex::test
