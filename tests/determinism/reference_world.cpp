// SPDX-License-Identifier: Apache-2.0
// What the tasks of the reference see: their behaviour is bound to the records here.
#include "determinism/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::determinism {

void Reference::fillWorld(int simplex) {
    RefSimplex& self = at(simplex);
    RefTask& task = *self.task;
    const SimplexPlan& plan = *task.plan;
    task.every = plan.every;
    task.phase = plan.phase >= 0
                     ? plan.phase
                     : static_cast<int>(self.rank % static_cast<std::size_t>(plan.every));
    task.lastRun = (task.phase - task.every) * period;
    task.behaviour = std::make_unique<Behaviour>(plan.seed, plan.wild);
    World& world = task.world;
    world.index = static_cast<std::size_t>(&plan - plan_.simplexes.data());
    for (std::size_t r = 0; r < plan.relations.size(); ++r) {
        Link& link = linkOf(simplex, r);
        if (link.rule->direction == Direction::Input)
            world.inputs.push_back(inputPort(link));
        else if (!isActive(link.target))
            world.outputs.push_back(outputPort(link));
    }
    for (const SenderPlan& sender : plan.senders) addSender(simplex, sender);
    for (const std::size_t choice : plan.choices) addChoice(simplex, choice);
    world.exchange = {plan.choices.size(), [this, simplex](std::uint64_t wanted, const Tick&) {
                          return handOver(simplex, wanted);
                      }};
    for (const LifePlan& life : plan.lives) addLife(simplex, life);
    world.result = &item<double>(simplex, "result");
    world.gain = &item<double>(simplex, "gain");
    world.total = &item<std::int64_t>(simplex, "total");
    world.heard = &item<std::int64_t>(simplex, "heard");
    world.choice = &item<std::int64_t>(simplex, "choice");
    if (self.shape->find("progress") != nullptr)
        world.progress = &item<double>(simplex, "progress");
    world.words = [this, simplex](std::string_view text) {
        item<std::string>(simplex, "words") = cut(text, 20);
    };
    world.fault = [this, simplex](std::int64_t code, std::string_view text) {
        fault(simplex, code, text);
    };
    world.setQuality = [this, &task](Quality quality, std::int64_t measuredAt) {
        task.qualitySet = true;
        task.quality = quality;
        const bool isNow = measuredAt == std::numeric_limits<std::int64_t>::min();
        task.measuredAt = isNow ? now_ : measuredAt;
    };
    world.event = [this, simplex](Severity severity, std::string_view text) {
        post(simplex, severity, EventKind::Message, std::string{text});
    };
}

Link& Reference::linkOf(int simplex, std::size_t planned) {
    return **std::ranges::find(at(simplex).links, planned, &Link::plan);
}

InputPort Reference::inputPort(Link& link) {
    InputPort port;
    Record& record = *link.seen;
    for (const Item& item : at(link.target).shape->items) {
        if (item.type->measured) continue;
        for (std::size_t i = item.first; i < item.first + item.type->length; ++i) {
            if (item.type->kind == Kind::Float) port.numbers.push_back(&record.floats[i]);
            if (item.type->kind == Kind::Int) port.integers.push_back(&record.ints[i]);
            if (item.type->kind == Kind::Bool) port.flags.push_back(&record.flags[i].on);
            if (item.type->kind == Kind::String) {
                port.texts.push_back([&record, i] { return std::string_view{record.texts[i]}; });
            }
        }
    }
    port.quality = [&record] { return record.state.quality; };
    port.stamp = [&record] { return record.state.time; };
    return port;
}

OutputPort Reference::outputPort(Link& link) {
    OutputPort port;
    Record& record = *link.seen;
    for (const Item& item : at(link.target).shape->items) {
        if (item.type->measured) continue;
        for (std::size_t i = item.first; i < item.first + item.type->length; ++i) {
            if (item.type->kind == Kind::Float) {
                port.numbers.push_back(&record.floats[i]);
                port.scales.push_back(scaleOf(*item.type));
            }
            const RefSimplex& target = at(link.target);
            if (item.type->kind == Kind::Float && target.demand) {
                port.accepted.emplace_back([&target, i] { return target.previous.floats[i]; });
            }
            if (item.type->kind == Kind::Int) port.integers.push_back(&record.ints[i]);
            if (item.type->kind == Kind::Bool) port.flags.push_back(&record.flags[i].on);
            if (item.type->kind != Kind::String) continue;
            const std::size_t capacity = item.type->capacity;
            port.texts.push_back([&record, i, capacity](std::string_view text) {
                record.texts[i] = cut(text, capacity);
            });
        }
    }
    return port;
}

void Reference::addSender(int simplex, const SenderPlan& plan) {
    Link& link = linkOf(simplex, plan.relation);
    RefTask& task = *at(simplex).task;
    const auto known = std::ranges::find(lines_, &link, &Line::link);
    if (known == lines_.end()) {
        Line& line = lines_.emplace_back();
        line.link = &link;
        line.delayed = link.delayed;
        at(link.owner).sending.push_back(&line);
        at(link.target).receiving.push_back(&line);
    }
    Line& line = known == lines_.end() ? lines_.back() : *known;
    line.capacity += plan.capacity;
    SenderHandle& handle = task.handles.emplace_back();
    handle.line = &line;
    handle.plan = &plan;
    task.world.senders.push_back({[this, &handle](double amount, std::int64_t number) {
                                      return send(handle, amount, number);
                                  },
                                  [&handle] {
                                      SeenAnswer answer = handle.answer;
                                      answer.why = handle.why;
                                      return answer;
                                  }});
}

void Reference::addLife(int simplex, const LifePlan& plan) {
    const Link& link = linkOf(simplex, plan.relation);
    const int target = link.target;
    const bool later = link.delayed;
    if (plan.manage) at(target).task->manager = simplex;
    const std::size_t place = at(target).shape->find("state")->first;
    at(simplex).task->world.lives.push_back(
        {[seen = link.seen, place] { return static_cast<State>(seen->ints[place]); },
         [this, target, later](LifeCycle command) { postLifeCycle(target, command, later); }});
}

}  // namespace cortex::determinism
