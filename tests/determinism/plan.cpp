// SPDX-License-Identifier: Apache-2.0
#include "determinism/plan.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace cortex::determinism {

std::uint64_t Chance::next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

double Chance::between(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11U) * 0x1p-53);
}

void Chance::mix(std::uint64_t bits) {
    state_ ^= bits * 0xff51afd7ed558ccdU;
    next();
}

namespace {

class Planner {
public:
    explicit Planner(std::uint64_t seed) : chance_{seed} { plan_.seed = seed; }

    Plan make();

private:
    SimplexPlan& at(std::size_t index) { return plan_.simplexes[index]; }
    std::size_t add(std::string type);
    void addTasks();
    void addSignals();
    void addLoops();
    void addExchange();
    void addReaders();
    void addTalk();
    void addScript();
    void addLate();
    bool relate(std::size_t owner, const char* rule, std::size_t target, bool delayed = false);
    void readSomething(std::size_t task);
    void talkTo(std::size_t task, std::size_t other);
    void maySend(std::size_t owner);
    OutsideCommandPlan ordered(std::int64_t tick);
    OutsideCommandPlan lifeCycle(std::int64_t tick);
    std::size_t task() { return chance_.below(tasks_); }
    static bool isDemand(const std::string& type) { return type.ends_with("Demand"); }

    Chance chance_;
    Plan plan_;
    std::size_t tasks_ = 0;  // the first so many simplexes, in an order that is possible
    std::vector<std::size_t> lastWriter_;  // by simplex: the last task that writes it, or 0
    std::set<std::string> taken_;
    std::set<std::size_t> managed_;
};

std::size_t Planner::add(std::string type) {
    static constexpr std::array folders{"/left", "/right", "/m/deep", ""};
    std::string path;
    do {
        path = folders[chance_.below(folders.size())];
        path += "/" + std::string(1, static_cast<char>('a' + chance_.below(26))) +
                std::to_string(chance_.below(30));
    } while (!taken_.insert(path).second);
    SimplexPlan simplex;
    simplex.path = path;
    simplex.type = std::move(type);
    simplex.seed = chance_.next();
    plan_.simplexes.push_back(std::move(simplex));
    lastWriter_.push_back(0);
    return plan_.simplexes.size() - 1;
}

void Planner::addTasks() {
    tasks_ = (plan_.chunkSize == 8 ? 10 : 6) + chance_.below(4);
    const std::size_t machines = 1 + chance_.below(2);
    for (std::size_t i = 0; i < tasks_; ++i) {
        const bool machine = i + machines >= tasks_;
        static constexpr std::array types{"Task", "QuickTask", "LongTask"};
        const std::size_t index = add(machine ? "Machine" : types[chance_.below(types.size())]);
        at(index).task = true;
        at(index).wild = i == 1 || chance_.oneIn(3);
        if (i != 2 && !chance_.oneIn(3)) continue;
        at(index).every = 2 + static_cast<int>(chance_.below(4));
        if (chance_.oneIn(2)) {
            at(index).phase =
                static_cast<int>(chance_.below(static_cast<std::uint64_t>(at(index).every)));
        }
    }
}

bool Planner::relate(std::size_t owner, const char* rule, std::size_t target, bool delayed) {
    const auto same = [&](const RelationPlan& each) {
        return each.rule == rule && each.target == at(target).path;
    };
    if (owner == target || std::ranges::any_of(at(owner).relations, same)) return false;
    at(owner).relations.push_back({rule, at(target).path, delayed});
    return true;
}

void Planner::addSignals() {
    static constexpr std::array types{"Signal", "StrictSignal", "SharedSignal",
                                      "StrictSharedSignal"};
    const std::size_t signals = 3 + chance_.below(4);
    for (std::size_t i = 0; i < signals; ++i) {
        const std::string type = i == 0 ? "SharedSignal" : types[chance_.below(types.size())];
        const std::size_t signal = add(type);
        const std::size_t writers =
            type.find("Shared") == std::string::npos ? 1 : 2 + chance_.below(2);
        for (std::size_t n = 0; n < writers; ++n) {
            const std::size_t writer = chance_.below(tasks_ - 2);
            relate(writer, "out", signal);
            lastWriter_[signal] = std::max(lastWriter_[signal], writer);
        }
        if (writers > 1 && lastWriter_[signal] + 1 < tasks_) {  // at least two
            const std::size_t writer = lastWriter_[signal] + 1;
            relate(writer, "out", signal);
            lastWriter_[signal] = writer;
        }
    }
}

// Controllers, demands, machines, readings: closed by the machines' delayed outputs.
void Planner::addLoops() {
    for (std::size_t machine = tasks_ - 1; at(machine).type == "Machine"; --machine) {
        const bool sharedDemand = chance_.oneIn(2);
        const std::size_t demand = add(sharedDemand ? "SharedDemand" : "Demand");
        const std::size_t reading = add(machine + 1 < tasks_ ? "SharedReading" : "Reading");
        relate(machine, "drives", demand);
        relate(machine, "readings", reading);
        if (machine + 1 < tasks_) relate(machine + 1, "readings", reading);
        for (std::size_t n = sharedDemand ? 2 : 1; n > 0; --n) {
            // A demand each: the n-th reading observes the n-th demand.
            const std::size_t controller = chance_.below(tasks_ - 2);
            if (!relate(controller, "demand", demand)) continue;
            relate(controller, "observed", reading);
            lastWriter_[demand] = std::max(lastWriter_[demand], controller);
        }
    }
}

// One task hands a shared simplex over between two or three others.
void Planner::addExchange() {
    if (!chance_.oneIn(2)) return;
    const std::size_t manager = chance_.below(2);
    const std::size_t shared = add(chance_.oneIn(2) ? "SharedSignal" : "StrictSharedSignal");
    std::size_t choices = 2 + chance_.below(2);
    for (std::size_t i = manager + 1; choices > 0 && i + 2 < tasks_; ++i) {
        if (!chance_.oneIn(2) && i + choices + 2 < tasks_) continue;
        const bool late = chance_.oneIn(6);
        if (!relate(manager, late ? "late" : "after", i, late) || !managed_.insert(i).second)
            continue;
        at(manager).choices.push_back(at(manager).relations.size() - 1);
        relate(i, "out", shared);
        lastWriter_[shared] = i;
        --choices;
    }
}

void Planner::readSomething(std::size_t reader) {
    static constexpr std::array rules{"in", "in", "held", "guarded", "vital"};
    const std::size_t target = tasks_ + chance_.below(plan_.simplexes.size() - tasks_);
    const bool written = std::ranges::any_of(
        at(reader).relations, [&](const auto& each) { return each.target == at(target).path; });
    if (written) return;
    if (at(target).type == "Setting") {
        relate(reader, "setting", target);
        return;
    }
    const bool delayed = lastWriter_[target] >= reader || chance_.oneIn(4);
    std::string rule = rules[chance_.below(rules.size())];
    const bool demands = std::ranges::any_of(at(reader).relations, [](const auto& each) {
        return each.rule == "out" || each.rule == "demand";
    });
    if (rule == "guarded" && !demands) rule = "in";  // it would make nothing safe
    relate(reader, rule.c_str(), target, delayed);
}

void Planner::addReaders() {
    add("Setting");
    const std::size_t bundle = add("Bundle");
    for (std::size_t i = tasks_; i < bundle; ++i) {
        if (!at(i).type.ends_with("Signal") || !chance_.oneIn(3)) continue;
        relate(bundle, "parts", i);
        lastWriter_[bundle] = std::max(lastWriter_[bundle], lastWriter_[i]);
    }
    for (std::size_t reader = 0; reader < tasks_; ++reader) {
        for (std::size_t n = 1 + chance_.below(3); n > 0; --n) readSomething(reader);
    }
}

void Planner::maySend(std::size_t owner) {
    static constexpr std::array commands{"add", "add", "poke", "zap", "work", "renew", "set"};
    const std::size_t relation = at(owner).relations.size() - 1;
    const auto target = std::ranges::find(plan_.simplexes, at(owner).relations[relation].target,
                                          &SimplexPlan::path);
    for (std::size_t n = 1 + chance_.below(2); n > 0; --n) {
        std::string command = commands[chance_.below(commands.size())];
        if (!target->task) command = "set";
        const bool isLong = command == "work" || command == "renew";
        if (isLong && target->type != "LongTask") command = "add";
        at(owner).senders.push_back(
            {relation, command, static_cast<std::uint32_t>(1 + chance_.below(3))});
    }
}

void Planner::talkTo(std::size_t first, std::size_t other) {
    if (first == other) return;
    std::size_t owner = std::min(first, other);
    std::size_t target = std::max(first, other);
    const char* rule = "after";
    bool delayed = false;
    if (chance_.oneIn(3)) {
        rule = "before";
        std::swap(owner, target);
    } else if (chance_.oneIn(3)) {
        rule = chance_.oneIn(2) ? "late" : "before";
        delayed = true;
        if (chance_.oneIn(2)) std::swap(owner, target);
    }
    if (!relate(owner, rule, target, delayed)) return;
    if (!chance_.oneIn(4)) maySend(owner);
    if (!chance_.oneIn(3)) return;
    const bool manage = chance_.oneIn(4) && managed_.insert(target).second;
    at(owner).lives.push_back({at(owner).relations.size() - 1, manage});
}

void Planner::addTalk() {
    const std::size_t popular = task();
    for (std::size_t n = tasks_ + chance_.below(4); n > 0; --n) {
        talkTo(task(), chance_.oneIn(2) ? popular : task());
    }
    for (std::size_t i = 0; i < tasks_; ++i) {
        for (std::size_t r = 0; r < at(i).relations.size(); ++r) {
            if (at(i).relations[r].rule != "setting" || chance_.oneIn(2)) continue;
            at(i).senders.push_back({r, "set", 2});
        }
    }
}

OutsideCommandPlan Planner::lifeCycle(std::int64_t tick) {
    static constexpr std::array commands{"startup", "startup", "clearFaults", "clearFaults",
                                         "shutdown"};
    static constexpr std::array prefixes{"/", "/", "/", "/left", "/m/deep/", "/nowhere"};
    const std::string command = commands[chance_.below(commands.size())];
    const bool group = chance_.oneIn(3);
    OutsideCommandPlan plan{tick, {}, group ? "/test" : at(task()).path, command, {}, 100};
    if (group) {
        const std::string prefix = command == "shutdown" ? "/right" : prefixes[chance_.below(6)];
        plan.arguments["prefix"] = std::vector{prefix};
    }
    return plan;
}

OutsideCommandPlan Planner::ordered(std::int64_t tick) {
    static constexpr std::array commands{"add", "poke", "zap", "set", "set", "work", "cancel"};
    std::string command = commands[chance_.below(commands.size())];
    std::size_t target = task();
    const bool needsLong = command == "work" || command == "cancel";
    for (std::size_t i = 0; needsLong && i < tasks_; ++i) {
        if (at(i).type == "LongTask") target = i;
    }
    if (needsLong && at(target).type != "LongTask") command = "add";
    if (command == "set" && chance_.oneIn(2)) {
        const auto setting = std::ranges::find(plan_.simplexes, "Setting", &SimplexPlan::type);
        target = static_cast<std::size_t>(setting - plan_.simplexes.begin());
    }
    OutsideCommandPlan plan{tick, {}, at(target).path, command, {}, 1};
    if (!chance_.oneIn(5)) plan.budget = 10;
    if (command == "set") {
        if (!chance_.oneIn(3)) plan.arguments["gain"] = std::vector{chance_.between(-1, 11)};
        if (!chance_.oneIn(3)) {
            plan.arguments["choice"] = std::vector{static_cast<std::int64_t>(chance_.below(7))};
        }
    } else if (command != "cancel") {
        plan.arguments["amount"] = std::vector{chance_.between(-11, 11)};
        plan.arguments["number"] = std::vector{std::int64_t{mostSimplexes - 1}};
    }
    return plan;
}

void Planner::addScript() {
    OutsideCommandPlan start{1, "anna", "/test", "startup", {}, 100};
    start.arguments["prefix"] = std::vector{std::string{"/"}};
    plan_.script.push_back(start);
    for (std::int64_t tick = 1; tick <= steps; ++tick) {
        if (chance_.oneIn(3)) plan_.script.push_back(lifeCycle(tick));
        for (std::uint64_t n = chance_.oneIn(4) ? 1 + chance_.below(4) : 0; n > 0; --n) {
            plan_.script.push_back(ordered(tick));
        }
    }
    static constexpr std::array senders{"zoe", "anna", "mia"};
    for (OutsideCommandPlan& each : plan_.script) each.sender = senders[chance_.below(3)];
}

void Planner::addLate() {
    plan_.overflow = chance_.oneIn(2)   ? OverflowPlan::Skip
                     : chance_.oneIn(3) ? OverflowPlan::Halt
                                        : OverflowPlan::CatchUp;
    plan_.catchUpCycles = static_cast<std::uint32_t>(1 + chance_.below(4));
    const std::uint64_t rarity = plan_.overflow == OverflowPlan::Halt ? 90 : 25;
    for (std::int64_t step = 1; step <= steps; ++step) {
        if (!chance_.oneIn(rarity)) continue;
        plan_.late.push_back({step, static_cast<std::int64_t>(1 + chance_.below(6))});
    }
}

Plan Planner::make() {
    plan_.chunkSize = plan_.seed % 3 == 0 ? 1 : plan_.seed % 12 == 1 ? 0 : 8;
    addTasks();
    addSignals();
    addLoops();
    addExchange();
    addReaders();
    addTalk();
    addScript();
    addLate();
    return std::move(plan_);
}

}  // namespace

bool Plan::hasDelayedEdges() const {
    return std::ranges::any_of(simplexes, [](const SimplexPlan& simplex) {
        return std::ranges::any_of(simplex.relations, [](const RelationPlan& relation) {
            return relation.delayed || relation.rule == "readings" || relation.rule == "late";
        });
    });
}

bool Plan::hasSharedSimplexes() const {
    return std::ranges::any_of(simplexes, [this](const SimplexPlan& simplex) {
        std::size_t writers = 0;
        for (const SimplexPlan& each : simplexes) {
            for (const RelationPlan& relation : each.relations) {
                const bool output = relation.rule == "out" || relation.rule == "demand" ||
                                    relation.rule == "readings";
                if (output && relation.target == simplex.path) ++writers;
            }
        }
        return writers > 1;
    });
}

bool Plan::hasRates() const {
    return std::ranges::any_of(simplexes, [](const SimplexPlan& each) { return each.every > 1; });
}

bool Plan::handsOver() const {
    return std::ranges::any_of(simplexes,
                               [](const SimplexPlan& each) { return each.choices.size() > 1; });
}

Plan makePlan(std::uint64_t seed) { return Planner{seed}.make(); }

}  // namespace cortex::determinism
