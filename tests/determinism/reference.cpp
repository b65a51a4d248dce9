// SPDX-License-Identifier: Apache-2.0
#include "determinism/reference.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <variant>

namespace cortex::determinism {

std::string inText(double number) {
    char buffer[32];
    char* const end = buffer + sizeof buffer;
    if (number == std::trunc(number)) return {buffer, std::to_chars(buffer, end, number).ptr};
    return {buffer, std::to_chars(buffer, end, number, std::chars_format::general, 6).ptr};
}

std::string inText(double number, double other) {
    char buffer[32];
    if (number == other || inText(number) != inText(other)) return inText(number);
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

std::string cut(std::string_view text, std::size_t capacity) {
    return std::string{text.substr(0, capacity)};
}

std::string inEvent(std::string_view text) {
    constexpr std::size_t capacity = 150, longWord = 40;
    if (text.size() <= capacity) return std::string{text};
    std::size_t end = capacity - 4;
    while ((static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
    const std::size_t blank = text.rfind(' ', end - 1);
    if (blank != std::string_view::npos && end - blank <= longWord) end = blank + 1;
    return cut(text, end) + "…";
}

Shape::Shape(const Type& type) {
    for (const DataItem& item : type.data) {
        if (item.constant) continue;
        std::visit(
            [&](const auto& values) {
                using Element = typename std::decay_t<decltype(values)>::value_type;
                const auto put = [&](auto& list) {
                    items.push_back({&item, list.size()});
                    for (std::size_t i = 0; i < item.length; ++i) {
                        const Element value =
                            values.empty() ? Element{} : values[std::min(i, values.size() - 1)];
                        list.push_back({value});
                    }
                };
                if constexpr (std::is_same_v<Element, double>) put(initial.floats);
                if constexpr (std::is_same_v<Element, std::int64_t>) put(initial.ints);
                if constexpr (std::is_same_v<Element, bool>) put(initial.flags);
                if constexpr (std::is_same_v<Element, std::string>) put(initial.texts);
            },
            item.initial);
    }
}

const Item* Shape::find(std::string_view name) const {
    for (const Item& item : items) {
        if (item.type->name == name) return &item;
    }
    return nullptr;
}

Reference::Reference(const Plan& plan, const TypeModel& types, Merge merge, std::uint64_t shuffle)
    : plan_{plan}, types_{types}, merge_{merge}, shuffle_{shuffle} {
    addSimplexes();
    addLinks();
    decideRoles();
    findOrder();
    bindLinks();
    findDevices();
    for (const int task : tasks_) fillWorld(task);
    for (RefSimplex& simplex : all_) {
        std::ranges::sort(simplex.receiving, {}, [&](const Line* line) {
            return std::pair{at(line->link->owner).rank, line->link->number};
        });
    }
    initialiseDemands();
}

void Reference::addSimplexes() {
    all_.resize(plan_.simplexes.size() + 1);
    std::vector<std::pair<std::string, const SimplexPlan*>> byPath{{"/test", nullptr}};
    for (const SimplexPlan& plan : plan_.simplexes) byPath.emplace_back(plan.path, &plan);
    std::ranges::sort(byPath);
    for (std::size_t i = 0; i < byPath.size(); ++i) {
        const auto& [path, plan] = byPath[i];
        RefSimplex& simplex = all_[i];
        simplex.path = path;
        simplex.type = &types_.at(plan != nullptr ? plan->type : "Cluster");
        auto& shape = shapes_[simplex.type];
        if (shape.items.empty()) shape = Shape{*simplex.type};
        simplex.shape = &shape;
        simplex.live = simplex.latch = simplex.previous = shape.initial;
        simplex.inEpisode.resize(shape.items.size());
        simplex.quiet.resize(shape.items.size());
        if (plan == nullptr) agent_ = static_cast<int>(i);
        if (plan == nullptr || !plan->task) continue;
        simplex.task = std::make_unique<RefTask>();
        simplex.task->plan = plan;
        simplex.live.state = {0, 0, static_cast<std::uint32_t>(i), Quality::Stale};
    }
}

int Reference::find(const std::string& path) const {
    const auto found = std::ranges::lower_bound(all_, path, {}, &RefSimplex::path);
    return static_cast<int>(found - all_.begin());
}

// By owner, then rule by name, then as related.
void Reference::addLinks() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const auto plan = std::ranges::find(plan_.simplexes, all_[i].path, &SimplexPlan::path);
        if (plan == plan_.simplexes.end()) continue;
        for (const Rule& rule : all_[i].type->rules) {
            for (std::size_t r = 0; r < plan->relations.size(); ++r) {
                const RelationPlan& relation = plan->relations[r];
                if (relation.rule != rule.name) continue;
                Link& link = links_.emplace_back();
                link.number = links_.size();
                link.owner = static_cast<int>(i);
                link.target = find(relation.target);
                link.rule = &rule;
                link.delayed = relation.delayed || rule.delayed;
                link.plan = r;
                all_[i].links.push_back(&link);
            }
        }
    }
}

void Reference::decideRoles() {
    for (Link& link : links_) {
        RefSimplex& target = at(link.target);
        if (link.rule->direction != Direction::Output || !isActive(link.owner) ||
            isActive(link.target)) {
            continue;
        }
        target.writers.push_back(link.owner);
        if (link.delayed) target.delayedOutput = true;
        target.demand = !link.delayed && target.type->role == Role::Descriptive;
    }
}

// An input before its owner, the owner before its outputs, all writers of a shared simplex before
// what is made of them; ties by path, or by chance.
std::vector<std::set<int>> Reference::dependencies() const {
    std::vector<std::set<int>> before(all_.size());
    for (const Link& link : links_) {
        const RefSimplex& target = all_[index(link.target)];
        if (link.rule->direction == Direction::Output) {
            const bool joins = isActive(link.owner) && target.writers.size() > 1;
            if (!link.delayed || joins) before[index(link.target)].insert(link.owner);
        } else if (!link.delayed && !target.delayedOutput) {
            before[index(link.owner)].insert(link.target);
        }
    }
    return before;
}

std::vector<int> Reference::orderBy(Chance* chance) const {
    std::vector<bool> done(all_.size());
    std::vector<int> order;
    while (order.size() < all_.size()) {
        std::vector<int> ready;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const auto isDone = [&](int each) { return done[index(each)]; };
            if (!done[i] && std::ranges::all_of(before_[i], isDone)) {
                ready.push_back(static_cast<int>(i));
            }
        }
        if (ready.empty()) throw std::logic_error{"the plan has a loop"};
        const int next = ready[chance != nullptr ? chance->below(ready.size()) : 0];
        done[index(next)] = true;
        order.push_back(next);
    }
    return order;
}

void Reference::findOrder() {
    before_ = dependencies();
    order_ = execution_ = orderBy(nullptr);
    startLevels_.resize(all_.size());
    for (const int simplex : order_) {
        int& level = startLevels_[index(simplex)];
        for (const int each : before_[index(simplex)]) {
            level = std::max(level, startLevels_[index(each)]);
        }
        if (isActive(simplex)) ++level;
        levels_ = std::max(levels_, level);
    }
    for (std::size_t i = 0; i < order_.size(); ++i) {
        at(order_[i]).rank = i;
        if (isActive(order_[i])) tasks_.push_back(order_[i]);
    }
    Chance chance{shuffle_};
    if (shuffle_ != 0) execution_ = orderBy(&chance);
}

void Reference::bindLinks() {
    for (Link& link : links_) {
        RefSimplex& target = at(link.target);
        const bool reads = link.rule->direction == Direction::Input || isActive(link.target);
        const bool old = reads && (link.delayed || target.delayedOutput);
        link.source = link.seen = old ? &target.latch : &target.live;
        const bool shared = !reads && target.writers.size() > 1;
        const bool held =
            link.rule->onLoss == OnLoss::Hold && link.rule->direction == Direction::Input;
        if (!isActive(link.owner)) continue;
        if (shared || held) {
            link.copy = std::make_unique<Record>(target.live);
            link.seen = link.copy.get();
        }
        if (shared) link.source = link.seen;
        if (shared) target.candidates.push_back(&link);
        RefTask& task = *at(link.owner).task;
        if (link.rule->direction == Direction::Input) task.inputs.push_back(&link);
        if (link.rule->direction == Direction::Output && !isActive(link.target)) {
            task.outputs.push_back(&link);
        }
    }
    for (RefSimplex& simplex : all_) {
        std::ranges::sort(simplex.candidates, {},
                          [&](const Link* link) { return at(link->owner).rank; });
    }
}

template <class T>
T& Reference::item(int simplex, std::string_view name) {
    Record& record = at(simplex).live;
    const std::size_t first = at(simplex).shape->find(name)->first;
    if constexpr (std::is_same_v<T, double>) return record.floats[first];
    if constexpr (std::is_same_v<T, std::int64_t>) return record.ints[first];
    if constexpr (std::is_same_v<T, std::string>) return record.texts[first];
}
template double& Reference::item<double>(int, std::string_view);
template std::int64_t& Reference::item<std::int64_t>(int, std::string_view);
template std::string& Reference::item<std::string>(int, std::string_view);

Observation Reference::run() {
    for (std::int64_t number = 1; number <= steps; ++number) {
        std::int64_t late = 0;
        for (const LatePlan& each : plan_.late) {
            if (each.cycle == number) late += each.periods;
        }
        tick(late);
        if (number % snapshotEvery == 0) observation_.snapshots.push_back(snapshot());
    }
    return std::move(observation_);
}

// One step(): its cycle, which takes so many periods longer, and what the overflow policy adds.
void Reference::tick(std::int64_t late) {
    cycle();
    if (late == 0) return;
    missed_.push_back(late);
    overflows_ += late;
    if (plan_.overflow == OverflowPlan::Halt) haltNext_ = true;
    if (plan_.overflow == OverflowPlan::CatchUp) {
        const std::int64_t atOnce = std::min<std::int64_t>(late, plan_.catchUpCycles);
        for (std::int64_t i = 0; i < atOnce; ++i) cycle();
        late -= atOnce;
    }
    nextTick_ += late;
}

void Reference::cycle() {
    now_ = nextTick_++ * period;
    ++cycle_;
    const std::int64_t passed = now_ - lastNow_;
    elapsed_ = std::min(passed, 3 * period);
    if (passed > elapsed_) {
        stoodUntil_ = now_;
        stood_ = passed;
    }
    lastNow_ = now_;
    halted_ = std::exchange(haltNext_, false);
    phase_ = 0;
    for (const std::int64_t missed : missed_) {
        reported_ += missed;
        post(agent_, Severity::Warning, EventKind::Overflow,
             "missed " + std::to_string(missed) + (missed == 1 ? " tick" : " ticks") + ", " +
                 std::to_string(reported_) + " since the start");
    }
    missed_.clear();
    for (RefSimplex& simplex : all_) simplex.latch = simplex.live;
    latchLines();
    readOutside();
    process(agent_, State::Active);
    for (const int simplex : order_) {
        if (!isActive(simplex) && simplex != agent_) process(simplex, State::Active);
    }
    phase_ = 1;
    for (const int simplex : execution_) {
        if (isActive(simplex))
            runTask(simplex);
        else if (at(simplex).writers.size() > 1)
            arbitrate(simplex);
    }
    at(agent_).live.state = {cycle_, now_, noSimplex, Quality::Good};
    item<std::int64_t>(agent_, "overflowCount") = overflows_;
    item<std::int64_t>(agent_, "commandCount") = commands_;
    item<std::int64_t>(agent_, "rejectedCount") = rejected_;
    item<std::int64_t>(agent_, "conflictCount") = conflicts_;
    item<std::int64_t>(agent_, "limitCount") = limits_;
    phase_ = 2;
    collect();
    closeEvents();
}

void Reference::post(int simplex, Severity severity, EventKind kind, std::string text) {
    posted_.push_back({at(simplex).rank,
                       phase_,
                       posted_.size(),
                       {cycle_, now_, 0, at(simplex).path, severity, kind, inEvent(text)}});
}

// Canonical order, then as posted.
void Reference::closeEvents() {
    std::ranges::sort(posted_, {}, [](const Posted& each) {
        return std::tuple{each.rank, each.phase, each.number};
    });
    for (Posted& each : posted_) {
        each.event.number = observation_.events.size() + 1;
        observation_.events.push_back(std::move(each.event));
    }
    posted_.clear();
}

std::vector<NamedType> Reference::simplexes() const {
    std::vector<NamedType> list;
    for (const RefSimplex& simplex : all_) list.push_back({simplex.path, simplex.type});
    return list;
}

Snapshot Reference::snapshot() const {
    Snapshot snapshot;
    snapshot.cycle = cycle_;
    for (const RefSimplex& simplex : all_) {
        for (const DataItem* type : comparedItems(*simplex.type)) {
            const Item& place = *simplex.shape->find(type->name);
            const Record& record = simplex.live;
            for (std::size_t i = place.first; i < place.first + type->length; ++i) {
                if (type->kind == Kind::Float) snapshot.add(record.floats[i]);
                if (type->kind == Kind::Int) snapshot.add(record.ints[i]);
                if (type->kind == Kind::Bool) snapshot.add(std::uint64_t{record.flags[i].on});
                if (type->kind == Kind::String) snapshot.add(record.texts[i], type->capacity);
            }
        }
        snapshot.add(simplex.live.state);
    }
    return snapshot;
}

}  // namespace cortex::determinism
