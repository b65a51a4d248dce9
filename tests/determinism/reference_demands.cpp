// SPDX-License-Identifier: Apache-2.0
// Demands in the reference: safe values, limits, and the choice between several writers.
#include "determinism/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace cortex::determinism {

namespace {

// Calls `copy` with the lists of the item's kind in both records.
void copyItem(const Item& item, const Record& from, std::size_t first, Record& to) {
    const auto copy = [&](const auto& source, auto& target) {
        std::copy_n(source.begin() + static_cast<std::ptrdiff_t>(first), item.type->length,
                    target.begin() + static_cast<std::ptrdiff_t>(item.first));
    };
    switch (item.type->kind) {
        case Kind::Float:
            return copy(from.floats, to.floats);
        case Kind::Int:
            return copy(from.ints, to.ints);
        case Kind::Bool:
            return copy(from.flags, to.flags);
        case Kind::String:
            return copy(from.texts, to.texts);
    }
}

// Items without a safe value are nobody's here.
bool equalItem(const Item& item, const Record& one, const Record& other) {
    bool equal = true;
    for (std::size_t i = item.first; i < item.first + item.type->length; ++i) {
        if (item.type->kind == Kind::Float) equal = equal && one.floats[i] == other.floats[i];
        if (item.type->kind == Kind::Int) equal = equal && one.ints[i] == other.ints[i];
        if (item.type->kind == Kind::Bool) equal = equal && one.flags[i].on == other.flags[i].on;
        if (item.type->kind == Kind::String) equal = equal && one.texts[i] == other.texts[i];
    }
    return equal || item.type->safe.kind == Safe::Kind::None || item.type->atRest == AtRest::Writer;
}

void storeGiven(const Item& item, const Value& value, Record& to) {
    for (std::size_t i = 0; i < item.type->length; ++i) {
        std::visit(
            [&](const auto& values) {
                using Element = typename std::decay_t<decltype(values)>::value_type;
                const Element element = values[values.size() == 1 ? 0 : i];
                if constexpr (std::is_same_v<Element, double>) to.floats[item.first + i] = element;
                if constexpr (std::is_same_v<Element, std::int64_t>)
                    to.ints[item.first + i] = element;
                if constexpr (std::is_same_v<Element, bool>) to.flags[item.first + i].on = element;
                if constexpr (std::is_same_v<Element, std::string>)
                    to.texts[item.first + i] = element;
            },
            value);
    }
}

bool stops(const Item& item) { return item.type->safe.kind == Safe::Kind::Stop; }

// The derivative of an item that stops.
bool stopsWithAnother(const Item& item) { return stops(item) && !item.type->derivativeOf.empty(); }

double numberOf(const std::optional<Number>& bound, double otherwise) {
    if (!bound) return otherwise;
    return std::visit([](auto number) { return static_cast<double>(number); }, *bound);
}

}  // namespace

// Before the first cycle every demand has its safe values.
void Reference::initialiseDemands() {
    for (RefSimplex& demand : all_) {
        if (demand.demand) demand.previous = demand.live;
    }
    for (const int simplex : tasks_) {
        for (Link* output : at(simplex).task->outputs) {
            RefSimplex& demand = at(output->target);
            if (!demand.demand) continue;
            std::size_t place = 0;
            std::vector<const Link*> observing;
            for (const Link* each : at(simplex).links) {
                if (each->rule == output->rule && each->plan < output->plan) ++place;
                if (each->rule->name == output->rule->counterpart) observing.push_back(each);
            }
            output->safe = *output->seen;
            if (!output->rule->counterpart.empty() && !observing.empty()) {
                const Link& observed = *observing[place < observing.size() ? place : 0];
                output->observed = observed.source;
                output->observedShape = at(observed.target).shape;
            }
            for (const Item& item : demand.shape->items) {
                if (item.type->safe.kind == Safe::Kind::Given) {
                    storeGiven(item, item.type->safe.value, output->safe);
                } else if (stopsWithAnother(item)) {
                    std::fill_n(
                        output->safe.floats.begin() + static_cast<std::ptrdiff_t>(item.first),
                        item.type->length, 0.0);
                } else if (item.type->safe.kind == Safe::Kind::Observed || stops(item)) {
                    copyItem(item, *output->observed,
                             output->observedShape->find(item.type->name)->first, output->safe);
                }
            }
            writeSafe(*output);
            output->seen->state = {0, 0, static_cast<std::uint32_t>(simplex), Quality::Stale};
        }
    }
    for (RefSimplex& simplex : all_) {
        if (!simplex.candidates.empty()) simplex.live = *simplex.candidates.front()->seen;
        simplex.previous = simplex.live;
    }
}

void Reference::latchSafe(int simplex, bool startsUp) {
    for (Link* output : at(simplex).task->outputs) latchSafe(*output, startsUp);
}

void Reference::latchSafe(Link& output, bool startsUp) {
    if (!at(output.target).demand) return;
    output.moved = false;
    output.startsUp = startsUp;
    takeSafe(output);
}

// What stops, by what went out last.
bool Reference::isMoving(const RefSimplex& demand) const {
    return std::ranges::any_of(demand.shape->items, [&](const Item& item) {
        for (std::size_t i = 0; stopsWithAnother(item) && i < item.type->length; ++i) {
            if (demand.previous.floats[item.first + i] != 0) return true;
        }
        return false;
    });
}

// A startup begins from the observation where all rests, or as soon as it does.
void Reference::takeSafe(Link& output) {
    const RefSimplex& demand = at(output.target);
    output.slows = !output.startsUp || isMoving(demand);
    const bool observesStops = !output.slows;
    for (const Item& item : demand.shape->items) {
        const Safe::Kind kind = item.type->safe.kind;
        if (kind == Safe::Kind::Given || kind == Safe::Kind::None) continue;
        const bool observes = kind == Safe::Kind::Observed ||
                              (stops(item) && observesStops && !stopsWithAnother(item));
        if (stopsWithAnother(item) && observesStops) {
            for (std::size_t i = 0; i < item.type->length; ++i)
                output.safe.floats[item.first + i] = 0;
        } else if (observes && output.observed->state.quality < Quality::Bad) {
            copyItem(item, *output.observed, output.observedShape->find(item.type->name)->first,
                     output.safe);
        } else {
            copyItem(item, demand.previous, item.first, output.safe);
        }
    }
}

// Each cycle anew from what went out last: the derivative goes to 0 by its rate, and the item by
// the mean of what its derivative was and is, for as long as it moves. At the end of the range both
// stand.
void Reference::slowDown(Link& output, double elapsed) {
    const RefSimplex& demand = at(output.target);
    if (!demand.demand) return;
    if (output.slows && output.startsUp && !isMoving(demand)) takeSafe(output);
    if (!output.slows) return;
    for (const Item& derivative : demand.shape->items) {
        if (!stopsWithAnother(derivative)) continue;
        const Item& item = *demand.shape->find(derivative.type->derivativeOf);
        for (std::size_t i = 0; i < item.type->length; ++i) {
            const double before = demand.previous.floats[derivative.first + i];
            const double place = demand.previous.floats[item.first + i];
            const double change = *derivative.type->rate * elapsed;
            double velocity = before > 0 ? before - change : before + change;
            if (std::abs(before) <= change) velocity = 0;
            const double moving = std::min(elapsed, std::abs(before) / *derivative.type->rate);
            const double next = place + (before + velocity) / 2 * moving;
            const double end =
                std::clamp(next, numberOf(item.type->min, next), numberOf(item.type->max, next));
            output.safe.floats[item.first + i] = end;
            output.safe.floats[derivative.first + i] = end == next ? velocity : 0;
        }
    }
}

void Reference::writeSafe(int simplex) {
    for (Link* output : at(simplex).task->outputs) writeSafe(*output);
}

// Not `all`: but for what is its writer's at rest.
void Reference::writeSafe(Link& output, bool all) {
    const RefSimplex& demand = at(output.target);
    if (!demand.demand) return;
    for (const Item& item : demand.shape->items) {
        const bool framework = all || item.type->atRest == AtRest::Safe;
        if (framework && item.type->safe.kind != Safe::Kind::None) {
            copyItem(item, output.safe, item.first, *output.seen);
        }
    }
}

// On the way between two states a demand is its safe value until a hook moves it.
void Reference::putSafe(int simplex, double elapsed) {
    for (Link* output : at(simplex).task->outputs) {
        if (output->moved) continue;
        slowDown(*output, elapsed);
        writeSafe(*output, false);
    }
}

// After the hooks, whichever of them wrote. Only in Active, and with all that it needs, a demand is
// what they say.
void Reference::settleSafe(int simplex, double elapsed) {
    const RefTask& task = *at(simplex).task;
    for (Link* output : task.outputs) {
        const RefSimplex& demand = at(output->target);
        output->standsSafe = false;
        if (!demand.demand) continue;
        if (resting(task.state) || task.safeByLoss) {
            if (resting(task.state)) tellInVain(simplex, *output, "a hook or handler", "");
            slowDown(*output, elapsed);
            writeSafe(*output, false);
            output->standsSafe = true;
        } else if (task.state != State::Active) {
            for (const Item& item : demand.shape->items) {
                output->moved = output->moved || !equalItem(item, *output->seen, output->safe);
            }
            output->standsSafe = !output->moved;
        }
    }
}

// Once a stay. What went out last may stand there as well, on its way to the safe value.
void Reference::tellInVain(int simplex, const Link& output, const std::string& who,
                           const std::string& remedy) {
    RefTask& task = *at(simplex).task;
    const RefSimplex& demand = at(output.target);
    for (const Item& item : demand.shape->items) {
        const bool wentOut =
            demand.writers.size() == 1 && equalItem(item, *output.seen, demand.previous);
        if (task.toldInVain || wentOut || equalItem(item, *output.seen, output.safe)) continue;
        task.toldInVain = true;
        post(simplex, Severity::Warning, EventKind::Message,
             "what " + who + " wrote to " + item.type->name + " of " + demand.path +
                 " does not go out: in " + name(task.state) + " it is its safe value" + remedy);
    }
}

// Whether the item whose derivative this one is stands at an end of its range.
bool Reference::endsAtItsRange(const RefSimplex& demand, const Item& derivative, std::size_t i) {
    if (!stopsWithAnother(derivative)) return false;
    const Item& item = *demand.shape->find(derivative.type->derivativeOf);
    const double place = demand.live.floats[item.first + i];
    return place <= numberOf(item.type->min, place - 1) ||
           place >= numberOf(item.type->max, place + 1);
}

LimitFinding Reference::limit(RefSimplex& demand, double elapsed) {
    lookAtDevices(demand);
    LimitFinding finding = limitItems(demand, elapsed);
    if (finding.notFinite) return finding;
    if (!demand.taken) standStill(demand, elapsed);
    tellSteps(demand, finding);
    return finding;
}

// Limits the live values of a demand against what it was when it was last sent.
LimitFinding Reference::limitItems(RefSimplex& demand, double elapsed) {
    LimitFinding finding;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto report = [&](std::size_t n, bool& first, double written, double became,
                            bool byRate) {
        const DataItem& type = *demand.shape->items[n].type;
        if (!first && !demand.inEpisode[n]) {
            finding.texts.push_back(type.name + " of " + demand.path + " limited from " +
                                    inText(written, became) + " to " + inText(became, written) +
                                    (type.unit.empty() ? "" : " " + type.unit) +
                                    (byRate ? " by its rate" : ""));
        }
        first = finding.limited = true;
    };
    for (std::size_t n = 0; n < demand.shape->items.size(); ++n) {
        const Item& item = demand.shape->items[n];
        const double min = numberOf(item.type->min, -infinity);
        const double max = numberOf(item.type->max, infinity);
        bool limited = false;
        for (std::size_t i = item.first; i < item.first + item.type->length; ++i) {
            if (item.type->kind == Kind::Float) {
                double& value = demand.live.floats[i];
                const double written = value;
                if (!std::isfinite(written)) {
                    finding.notFinite = finding.faults = true;
                    finding.item = item.type;
                    finding.texts.push_back(item.type->name + " of " + demand.path +
                                            " was not a number");
                    return finding;
                }
                value = std::clamp(written, min, max);
                const double inRange = value;
                const bool outOfRange = inRange != written;
                if (item.type->rate) {
                    const double step = *item.type->rate * elapsed;
                    const double before = demand.previous.floats[i];
                    const bool free = value == 0 && endsAtItsRange(demand, item, i - item.first);
                    if (!free) value = std::clamp(value, before - step, before + step);
                }
                if (value == written) continue;
                report(n, limited, written, value, value != inRange);
                if (!outOfRange || item.type->onLimit != OnLimit::Fault) continue;
            } else if (item.type->kind == Kind::Int) {
                std::int64_t& value = demand.live.ints[i];
                const std::int64_t written = value;
                if (item.type->min) value = std::max(value, std::get<0>(*item.type->min));
                if (item.type->max) value = std::min(value, std::get<0>(*item.type->max));
                if (value == written) continue;
                report(n, limited, static_cast<double>(written), static_cast<double>(value), false);
                if (item.type->onLimit != OnLimit::Fault) continue;
            } else {
                continue;
            }
            if (!finding.faults) finding.item = item.type;
            finding.faults = true;
        }
        demand.quiet[n] = limited ? 0 : demand.quiet[n] + elapsed;
        demand.inEpisode[n] = limited || (demand.inEpisode[n] && demand.quiet[n] < 1);
    }
    return finding;
}

// After a task: each demand that it alone writes. What is not a number or faults becomes safe, and
// no demand moves further than its rate allows, safe or not.
void Reference::limitOutputs(int simplex, double elapsed) {
    RefTask& task = *at(simplex).task;
    bool again = false;
    for (Link* output : task.outputs) {
        RefSimplex& demand = at(output->target);
        if (!demand.demand || demand.writers.size() > 1) continue;
        const LimitFinding finding = limit(demand, elapsed);
        output->notFinite = finding.notFinite;
        again = again || finding.notFinite;
        if (!output->standsSafe) postLimits(simplex, finding.texts);  // else it is on its way
        postLimits(simplex, finding.steps);
        if (output->standsSafe) continue;
        if (finding.limited) ++limits_;
        if (!finding.faults) continue;
        fault(simplex, finding.notFinite ? -3 : -4,
              finding.item->name + " of " + demand.path +
                  (finding.notFinite ? " was not a number" : " was out of range"));
    }
    again = again || task.faultPending;
    if (task.faultPending) {
        enterFault(simplex);
        settleSafe(simplex, elapsed);
    }
    for (Link* output : task.outputs) {
        RefSimplex& demand = at(output->target);
        if (!demand.demand || demand.writers.size() > 1) continue;
        if (output->notFinite) writeSafe(*output);
        if (again && limit(demand, elapsed).notFinite) demand.live = demand.previous;
        demand.previous = demand.live;
    }
}

// Of several that one manager hands the demand over between, the one that became Active last.
void Reference::arbitrate(int simplex) {
    RefSimplex& target = at(simplex);
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < target.candidates.size(); ++i) {
        if (at(target.candidates[i]->owner).task->state == State::Active) active.push_back(i);
    }
    const auto writer = [&](std::size_t i) -> const RefTask& {
        return *at(target.candidates[i]->owner).task;
    };
    const bool oneManager = !active.empty() && writer(active[0]).manager >= 0 &&
                            std::ranges::all_of(active, [&](std::size_t i) {
                                return writer(i).manager == writer(active[0]).manager;
                            });
    if (oneManager) {
        target.selected = *std::ranges::max_element(
            active, {}, [&](std::size_t i) { return writer(i).stateSince; });
    } else if (!active.empty()) {
        target.selected = active[0];
    }
    const bool conflict = active.size() > 1 && !oneManager;
    Link& chosen = *target.candidates[target.selected];
    if (conflict) {
        ++conflicts_;
        if (!target.inConflict) {
            post(simplex, Severity::Warning, EventKind::Conflict,
                 "several writers are Active; taken is " + at(chosen.owner).path);
        }
    }
    target.inConflict = conflict;
    const double elapsed = static_cast<double>(elapsed_) * 1e-9;
    const bool stopping =
        target.demand && chosen.standsSafe && std::ranges::any_of(target.shape->items, stops);
    if (stopping) {
        slowDown(chosen, elapsed);
        writeSafe(chosen, false);
    }
    target.live = *chosen.seen;
    if (!target.demand) return;
    const LimitFinding finding = limit(target, elapsed);
    const bool reports = !chosen.standsSafe;
    if (reports) {
        if (finding.limited) ++limits_;
        postLimits(simplex, finding.texts);
        if (finding.faults) {
            chosen.refused = finding.item;
            chosen.refusedNotFinite = finding.notFinite;
        }
    }
    postLimits(simplex, finding.steps);
    if (finding.notFinite || (finding.faults && reports)) {
        latchSafe(chosen);
        slowDown(chosen, elapsed);
        writeSafe(chosen);
        target.live = *chosen.seen;
        target.live.state = {cycle_, now_, static_cast<std::uint32_t>(chosen.owner),
                             Quality::Stale};
        if (limit(target, elapsed).notFinite) {
            const SlotState state = target.live.state;
            target.live = target.previous;
            target.live.state = state;
        }
    }
    target.previous = target.live;
}

}  // namespace cortex::determinism
