// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/testing.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/model_files.hpp"
#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/tables.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include "tasks/crash_report.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <span>

namespace cortex::cs {

namespace {

// Longer than the usual timeouts at 1 kHz.
constexpr int mostCyclesOfACall = 20'000;

ModelFiles readAll(const std::vector<std::filesystem::path>& files) {
    Report report;
    ModelFiles model = readModelFiles(files, report);
    if (!report.ok()) throw ModelError(std::move(report));
    return model;
}

std::string nameOf(const SystemDescription& system, const std::string& wanted) {
    if (!wanted.empty()) return wanted;
    return system.clusters.size() == 1 ? system.clusters.front().name : "plant";
}

}  // namespace

struct TestPlant::Implementation {
    Implementation(ModelFiles model, const std::string& wantedName)
        : system{std::move(model.system)},
          tree{std::move(model.types)},
          name{nameOf(system, wantedName)},
          cluster{name} {}

    ClassRegistry classes;
    SystemDescription system;
    SimplexTree tree;
    std::string name;
    ClusterCS cluster;
    ManualTrigger* trigger = nullptr;
    bool started = false;

    template <class Function>
    void forEachActive(const Function& function) {
        for (const auto& [path, simplex] : tree.simplexes()) {
            auto* active = dynamic_cast<SimplexCS*>(simplex.get());
            if (active != nullptr) function(path, *active);
        }
    }
    std::span<const std::byte> tables() { return cluster.agent().tables().arena(); }
};

TestPlant::TestPlant(const std::vector<std::filesystem::path>& files,
                     std::chrono::nanoseconds period, const std::string& name)
    : implementation_{std::make_unique<Implementation>(readAll(files), name)} {
    implementation_->trigger = &cluster().setTriggerSource<ManualTrigger>(period);
}

TestPlant::~TestPlant() = default;

void TestPlant::loadPlugin(const std::filesystem::path& file) {
    implementation_->classes.loadPlugin(file, tree().types());
}

ClassRegistry& TestPlant::classes() { return implementation_->classes; }

void TestPlant::add(const std::string& path, const std::string& type, const Pairs& relates,
                    const Pairs& settings) {
    SystemDescription::SimplexEntry entry;
    entry.path = path;
    entry.type = type;
    for (const auto& [rule, to] : relates) entry.relates.push_back({rule, to, false, false, {}});
    for (const auto& [item, value] : settings) entry.settings.push_back({item, value, {}});
    add(std::move(entry));
}

void TestPlant::add(SystemDescription::SimplexEntry simplex) {
    if (implementation_->started)
        throw Error(simplex.path + ": a plant that was started takes no more simplexes");
    implementation_->system.simplexes.push_back(std::move(simplex));
}

void TestPlant::start() {
    Report report;
    tree().add(implementation_->system, &classes(), report);
    if (!report.ok()) throw ModelError(std::move(report));
    cluster().addSimplexTree(tree());
    cluster().useClasses(classes());
    ClusterTesting::judgeAsPart(cluster());
    cluster().start();
    implementation_->started = true;
    step();
}

void TestPlant::step(std::int64_t cycles) {
    if (!implementation_->started) throw Error("a plant steps after start()");
    implementation_->trigger->step(cycles);
}

void TestPlant::standStill(std::int64_t periods) {
    if (!implementation_->started) throw Error("a plant stands still after start()");
    if (periods < 0)
        throw Error("a plant stands still for 0 periods or more, not " + std::to_string(periods));
    ClusterTesting::playLate(*implementation_->trigger, periods);
    step();
}

CallResult TestPlant::call(std::string_view path, std::string_view command,
                           const Arguments& arguments) {
    const std::uint64_t sent = cluster().send(path, command, arguments);
    CallResult answer;
    for (int i = 0; i < mostCyclesOfACall; ++i) {
        if (cluster().program().poll(sent, answer)) return answer;
        step();
    }
    throw Error(std::string{path} + ": '" + std::string{command} + "' has no answer after " +
                std::to_string(mostCyclesOfACall) +
                " cycles; send a command that takes longer by cluster().send()");
}

void TestPlant::startUp() {
    const CallResult answer = call("/" + implementation_->name, "startup",
                                   {{"prefix", Value{std::vector<std::string>{"/"}}}});
    if (!answer.done()) throw Error("startup: " + answer.text());
}

State TestPlant::state(std::string_view path) {
    return static_cast<State>(get<std::int64_t>(path, "state"));
}

std::int64_t TestPlant::cycle() { return cluster().agent().cycle(); }
SimplexTree& TestPlant::tree() { return implementation_->tree; }
ClusterCS& TestPlant::cluster() { return implementation_->cluster; }

TestPlant::Saved TestPlant::save() {
    Saved saved;
    const std::span<const std::byte> tables = implementation_->tables();
    saved.tables.assign(tables.begin(), tables.end());
    implementation_->forEachActive([&](const std::string& path, SimplexCS& simplex) {
        saved.kept[path] = simplex.savedState();
    });
    return saved;
}

void TestPlant::restore(const Saved& saved) {
    const std::span<const std::byte> tables = implementation_->tables();
    if (tables.size() != saved.tables.size()) {
        throw Error("what was saved is of another plant: its tables have " +
                    std::to_string(saved.tables.size()) + " bytes, these have " +
                    std::to_string(tables.size()));
    }
    for (const auto& [path, kept] : saved.kept) {
        auto* simplex = dynamic_cast<SimplexCS*>(&tree().at(path));
        if (simplex == nullptr) throw Error(path + " was saved as active, and is not");
        simplex->restoreState(kept);
    }
    std::memcpy(const_cast<std::byte*>(tables.data()), saved.tables.data(), tables.size());
    cluster().agent().tables().acceptLive();
}

TestPlant::Values TestPlant::values() {
    Values all;
    AgentRuntime& agent = cluster().agent();
    for (std::uint32_t i = 0; i < agent.structure().simplexes.size(); ++i) {
        const SimplexInfo& info = agent.structure().simplexes[i];
        if (i == agent.agentSimplex()) continue;
        for (const ItemLayout& each : info.layout->items) {
            if (each.constant || each.item->measured) continue;
            const void* cell = agent.tables().live(i).at(each.item->kind, each.offset);
            all.emplace(info.path + "." + each.item->name, toText(loadValue(*each.item, cell)));
        }
    }
    return all;
}

std::string TestPlant::differences(const Values& one, const Values& other) {
    std::string text;
    const auto of = [](const Values& values, const std::string& item) {
        const auto found = values.find(item);
        return found == values.end() ? std::string{"not there"} : found->second;
    };
    Values all = one;
    all.insert(other.begin(), other.end());
    for (const auto& [item, value] : all) {
        const std::string first = of(one, item), second = of(other, item);
        if (first != second) text += item + " is " + first + " and " + second + "\n";
    }
    return text;
}

void ClusterTesting::set(ClusterCS& cluster, TestOptions options) {
    optionsOf(cluster) = std::move(options);
}

void ClusterTesting::judgeAsPart(ClusterCS& cluster) { optionsOf(cluster).extent = Extent::Part; }

void ClusterTesting::onThreadStart(ClusterCS& cluster, std::function<void()> function) {
    std::function<void(std::uint32_t)>& all = optionsOf(cluster).onThreadStart;
    all = [before = std::move(all), function = std::move(function)](std::uint32_t thread) {
        function();
        if (before) before(thread);
    };
}

ClusterTesting::RunningHook ClusterTesting::runningHook() noexcept {
    const HookOfThread running = hookOfThisThread();
    if (running.simplex == nullptr) return {};
    return {running.simplex->path, running.simplex->layout->type->name, name(running.hook)};
}

void ClusterTesting::playLate(ManualTrigger& trigger, std::int64_t periods) {
    const std::lock_guard lock{trigger.mutex_};
    trigger.requestedLate_ += periods;
}

}  // namespace cortex::cs
