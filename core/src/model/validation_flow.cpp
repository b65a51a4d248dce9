// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/system_findings.hpp"

#include "model/relationship_order.hpp"
#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"
#include "model/validation_checks.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

namespace cortex {
namespace {

constexpr std::size_t mostPrinted = 10'000;

// The edges of a structure with the relations that they come from, and the simplexes by index.
class Flow {
public:
    explicit Flow(const Checked& checked) : checked_{checked} {
        for (const auto& [path, simplex] : checked.tree.simplexes()) {
            simplexes_.push_back(simplex.get());
            for (const auto& resolved : resolveRelations(checked.tree, *simplex)) {
                const auto target = checked.structure.find(resolved.relation->target);
                if (target != noSimplex) relations_.push_back(resolved.relation);
            }
        }
    }

    void checkWriters();
    void checkRemoteTypes();
    void checkDemands();
    void checkLoops();
    void checkLoss();
    void checkUnwritten();

private:
    const Edge& edge(std::uint32_t index) const { return checked_.structure.edges[index]; }
    const SimplexInfo& info(std::uint32_t index) const {
        return checked_.structure.simplexes[index];
    }
    const Simplex& owner(const Edge& each) const { return *simplexes_[each.owner]; }
    bool writes(const Edge& each) const {
        return each.rule->direction == Direction::Output && info(each.owner).role == Role::Active &&
               info(each.target).role != Role::Active && !info(each.target).remote;
    }
    std::string relateOf(std::uint32_t index, bool delayed) const {
        Simplex::Relation relation = *relations_[index];
        relation.delayed = delayed;
        return relateText(relation);
    }

    static bool hasSource(const SimplexInfo& target);
    void checkSecondWriter(std::uint32_t index);
    void checkSecondRule(std::uint32_t first, std::uint32_t second);
    void checkMixed(const std::vector<std::uint32_t>& outputs);
    void checkSafe(const SimplexInfo& demand, const Simplex& simplex);
    void checkObserved(std::uint32_t index);
    std::span<const Edge> edgesUnder(std::uint32_t simplex, std::string_view rule) const;
    std::string observationError(const Edge& output, std::string_view rule,
                                 const DataItem& item) const;
    std::string counterpartRemedy(const Edge& output, const DataItem& item) const;
    void reportLoop(const Loop& loop);

    const Checked& checked_;
    std::vector<const Simplex*> simplexes_;
    std::vector<const Simplex::Relation*> relations_;  // by edge
};

void Flow::checkWriters() {
    std::vector<std::vector<std::uint32_t>> outputs(checked_.structure.simplexes.size());
    for (std::uint32_t index = 0; index < relations_.size(); ++index) {
        if (writes(edge(index))) outputs[edge(index).target].push_back(index);
    }
    for (const auto& edges : outputs) {
        if (edges.empty()) continue;
        if (edge(edges.front()).owner != edge(edges.back()).owner) checkMixed(edges);
        for (std::size_t n = 1; n < edges.size(); ++n) {
            const Edge &before = edge(edges[n - 1]), &each = edge(edges[n]);
            if (each.owner != before.owner)
                checkSecondWriter(edges[n]);
            else if (each.rule != before.rule)
                checkSecondRule(edges[n - 1], edges[n]);
        }
    }
}

void Flow::checkSecondWriter(std::uint32_t index) {
    const SimplexInfo& target = info(edge(index).target);
    const Type& type = *target.layout->type;
    if (type.manyWriters) return;
    checked_.report.error(target.path, finding::severalWriters, relations_[index]->place,
                          owner(edge(index)).path() + " writes it by " +
                              ruleText(owner(edge(index)), *edge(index).rule) + ", and so does " +
                              info(target.writers.front()).path,
                          "remove this <relate>, or let both write simplexes of their own and a "
                          "third combine them; if only one of them is ever Active, write "
                          "writers=\"many\" for type " +
                              type.name + " (" + type.place.text() + ")");
}

// One owner would write the same data by two rules. The later <relate> is one too many; where one
// rule refines the other, the more general.
void Flow::checkSecondRule(std::uint32_t first, std::uint32_t second) {
    const Simplex& writer = owner(edge(second));
    const auto refines = [&](std::uint32_t inner, std::uint32_t general) {
        return countsFor(writer.type(), edge(inner).rule->name, edge(general).rule->name);
    };
    if (relations_[second] < relations_[first]) std::swap(first, second);
    if (refines(second, first)) std::swap(first, second);
    const std::string remedy = refines(first, second)
                                   ? ": one under '" + edge(first).rule->name + "' counts for '" +
                                         edge(second).rule->name + "' too"
                                   : ", or relate another simplex";
    checked_.report.error(writer.path(), finding::outputTwice, relations_[second]->place,
                          ruleText(writer, *edge(second).rule) + " writes " +
                              info(edge(second).target).path + ", and so does " +
                              ruleText(writer, *edge(first).rule),
                          "remove this <relate>" + remedy);
}

// Either all writers of a simplex are delayed or none: an observation, or a demand.
void Flow::checkMixed(const std::vector<std::uint32_t>& outputs) {
    const auto delayed = [&](std::uint32_t index) { return edge(index).delayed; };
    if (std::ranges::all_of(outputs, delayed) || std::ranges::none_of(outputs, delayed)) return;
    const auto alone = std::ranges::find_if(
        outputs, [&](std::uint32_t index) { return delayed(index) && !edge(index).rule->delayed; });
    const bool undo = alone != outputs.end();  // delayed by its <relate> only: undo that
    const std::uint32_t odd = undo ? *alone : *std::ranges::find_if_not(outputs, delayed);
    checked_.report.error(
        info(edge(odd).target).path, finding::delayedMixed, relations_[odd]->place,
        ruleText(owner(edge(odd)), *edge(odd).rule) + " of " + owner(edge(odd)).path() +
            " writes it " + (undo ? "delayed, others not" : "at once, others delayed"),
        "write " + relateOf(odd, !undo));
}

// Rules that name one remote path must agree on what can be there.
void Flow::checkRemoteTypes() {
    for (std::uint32_t index = 0; index < relations_.size(); ++index) {
        const SimplexInfo& target = info(edge(index).target);
        const std::string& wanted = edge(index).rule->target;
        if (!target.remote || target.layout->type->isA(wanted)) continue;
        checked_.report.error(
            owner(edge(index)).path(), finding::remoteTypes, relations_[index]->place,
            ruleText(owner(edge(index)), *edge(index).rule) + " takes " + wanted +
                "; as another rule has it, " + target.path + " is " + target.layout->type->name,
            "remove this <relate>, or relate a simplex that is both");
    }
}

void Flow::checkDemands() {
    for (std::uint32_t index = 0; index < simplexes_.size(); ++index) {
        if (info(index).role == Role::Modification) checkSafe(info(index), *simplexes_[index]);
    }
    for (std::uint32_t index = 0; index < relations_.size(); ++index) {
        const Edge& each = edge(index);
        const bool demand = writes(each) && info(each.target).role == Role::Modification;
        if (demand && !each.delayed) checkObserved(index);
        if (!demand || !each.delayed) continue;
        checked_.report.warning(
            owner(each).path(), finding::delayedDemand, relations_[index]->place,
            ruleText(owner(each), *each.rule) + " delays a demand: " + info(each.target).path +
                " is a modification",
            "write " + relateOf(index, false));
    }
}

void Flow::checkSafe(const SimplexInfo& demand, const Simplex& simplex) {
    const Type& type = simplex.type();
    std::vector<std::string> names;
    const DataItem* first = nullptr;
    for (const DataItem& item : type.data) {
        if (item.safe.kind != Safe::Kind::None || item.constant || item.measured) continue;
        if (first == nullptr) first = &item;
        names.push_back("'" + item.name + "'");
    }
    if (names.empty()) return;
    const std::string writer =
        demand.writers.empty() ? "" : " that " + info(demand.writers.front()).path + " writes";
    checked_.report.error(demand.path, finding::safeNeeded, simplex.place(),
                          "it is a modification" + writer + ", but " + listText(names) +
                              " of type " + type.name + " has no safe value",
                          "say for '" + first->name + "' (" + first->place.text() +
                              ") what is safe for the plant: safe=\"…\" with a value, hold (the "
                              "last demand), observed (where it is) or stop (it slows down)");
}

// Edges of a simplex lie by rule: those under one rule are neighbours.
std::span<const Edge> Flow::edgesUnder(std::uint32_t simplex, std::string_view rule) const {
    const std::span<const Edge> all{checked_.structure.edges};
    const auto own = all.subspan(info(simplex).firstEdge, info(simplex).edgeCount);
    const auto ruleName = [](const Edge& each) -> std::string_view { return each.rule->name; };
    const auto [first, last] = std::ranges::equal_range(own, rule, {}, ruleName);
    return {first, last};
}

// "" if the n-th simplex under `rule`, or its only one, observes the item that is demanded n-th.
std::string Flow::observationError(const Edge& output, std::string_view rule,
                                   const DataItem& item) const {
    const auto demanded = edgesUnder(output.owner, output.rule->name);
    const auto observing = edgesUnder(output.owner, rule);
    const auto place = static_cast<std::size_t>(&output - demanded.data());
    const std::size_t position = observing.size() == 1 ? 0 : place;
    if (position >= observing.size()) {
        return "has its counterpart under rule '" + std::string{rule} +
               "', which has no simplex in place " + std::to_string(position + 1);
    }
    const SimplexInfo& observed = info(observing[position].target);
    const DataItem* found = observed.layout->type->findData(item.name);
    if (found == nullptr) {
        return "observes " + observed.path + ", a " + observed.layout->type->name +
               ", which has no '" + item.name + "'";
    }
    const bool same =
        found->kind == item.kind && found->length == item.length && found->unit == item.unit;
    return same ? "" : "observes " + observed.path + ", whose '" + item.name + "' is another value";
}

std::string Flow::counterpartRemedy(const Edge& output, const DataItem& item) const {
    for (const Rule& rule : owner(output).type().rules) {
        if (rule.direction != Direction::Input) continue;
        if (!observationError(output, rule.name, item).empty()) continue;
        return "write counterpart=\"" + rule.name + "\" for rule '" + output.rule->name + "' (" +
               output.rule->place.text() + ")";
    }
    const std::string& rule = output.rule->counterpart;
    for (const Edge& observing : edgesUnder(output.owner, rule)) {
        const SimplexInfo& observed = info(observing.target);
        const std::string& demanded = info(output.target).layout->type->name;
        if (!observed.remote || observed.layout->type->isA(demanded)) continue;
        const std::string type = "type=\"" + demanded + "\"";
        return "say of which type it is in its agent: write " +
               relateText(rule, observed.path, "remote=\"true\" " + type);
    }
    return rule.empty() ? "add an input rule that observes it, and name it as counterpart"
                        : "relate a simplex that has '" + item.name + "' with " +
                              relateText(rule, "…") + ", in the order of the demands";
}

void Flow::checkObserved(std::uint32_t index) {
    const Edge& output = edge(index);
    for (const DataItem& item : info(output.target).layout->type->data) {
        if (!latchesObservation(item)) continue;
        const std::string& rule = output.rule->counterpart;
        const std::string wrong =
            rule.empty() ? "states no counterpart" : observationError(output, rule, item);
        if (wrong.empty()) continue;
        checked_.report.error(owner(output).path(), finding::observedCounterpart,
                              relations_[index]->place,
                              "'" + item.name + "' of " + info(output.target).path + " is safe=\"" +
                                  (item.safe.kind == Safe::Kind::Stop ? "stop" : "observed") +
                                  "\", but " + ruleText(owner(output), *output.rule) + " " + wrong,
                              counterpartRemedy(output, item));
        if (rule.empty()) return;  // one item says it for all
    }
}

void Flow::checkLoops() {
    std::size_t printed = 0;  // simplexes: many long loops are one mistake
    for (const Loop& loop : findLoops(checked_.structure)) {
        if (printed > mostPrinted) break;
        reportLoop(loop);
        printed += loop.size();
    }
}

// To be delayed: rather what is observed than what is ordered, and never a demand.
void Flow::reportLoop(const Loop& loop) {
    std::string text;
    for (const std::uint32_t index : loop) text += info(orderOf(edge(index)).first).path + " -> ";
    text += info(orderOf(edge(loop.front())).first).path;
    const std::uint32_t best = *std::ranges::min_element(loop, {}, [&](std::uint32_t index) {
        const bool input = edge(index).rule->direction == Direction::Input;
        const bool demand = info(edge(index).target).role == Role::Modification;
        return !input ? 2 : demand ? 1 : 0;
    });
    checked_.report.error(info(orderOf(edge(loop.front())).first).path, finding::loop,
                          relations_[best]->place,
                          "each of these waits for the one before: " + text,
                          "write " + relateOf(best, true) + " in " + owner(edge(best)).path());
}

// Cycles between two writings of what the edge reads, 0 if this agent does not write it.
// Who reacts to a loss with safe values must have some. What lacks outputs has a finding already.
void Flow::checkLoss() {
    std::vector<bool> demands(simplexes_.size(), false);
    for (std::size_t i = 0; i < simplexes_.size(); ++i) {
        demands[i] = std::ranges::any_of(simplexes_[i]->type().rules, [&](const Rule& rule) {
            return rule.direction == Direction::Output &&
                   relationsFor(*simplexes_[i], rule).size() < rule.min;
        });
    }
    for (std::uint32_t index = 0; index < relations_.size(); ++index) {
        const Edge& each = edge(index);
        if (writes(each) && info(each.target).role == Role::Modification)
            demands[each.owner] = true;
    }
    for (std::uint32_t index = 0; index < relations_.size(); ++index) {
        const Edge& each = edge(index);
        const bool active = info(each.owner).role == Role::Active;
        if (each.rule->onLoss != OnLoss::Safe || !active || demands[each.owner]) continue;
        demands[each.owner] = true;  // one relationship says it for all
        checked_.report.warning(
            owner(each).path(), finding::safeNothing, relations_[index]->place,
            ruleText(owner(each), *each.rule) +
                " has onLoss=\"safe\", but nothing that it writes is a demand: a loss would make "
                "nothing safe, and stateActive would be left out",
            "write onLoss=\"propagate\" for rule '" + each.rule->name + "' (" +
                each.rule->place.text() + "), and ask inputLost() in the hooks");
    }
}

// Whether anything could ever change what an input reads.
bool Flow::hasSource(const SimplexInfo& target) {
    return target.remote || target.role == Role::Active || !target.writers.empty() ||
           std::ranges::any_of(target.layout->type->data,
                               [](const DataItem& item) { return !item.settable.empty(); });
}

// A stop that no simplex tells is never seen, and neither is its loss. One finding for each rule.
void Flow::checkUnwritten() {
    std::set<std::uint32_t> told;
    for (std::uint32_t index = 0; index < relations_.size();) {
        const std::uint32_t first = index;
        const Rule& rule = *edge(first).rule;
        const bool reacts = rule.direction == Direction::Input &&
                            info(edge(first).owner).role == Role::Active &&
                            (rule.onLoss == OnLoss::Safe || rule.onLoss == OnLoss::Fault);
        std::vector<std::string> unwritten;
        std::uint32_t at = first;
        for (; index < relations_.size(); ++index) {
            const Edge& each = edge(index);
            if (each.owner != edge(first).owner || each.rule != &rule) break;
            if (!reacts || hasSource(info(each.target)) || !told.insert(each.target).second)
                continue;
            if (unwritten.empty()) at = index;
            unwritten.push_back(info(each.target).path);
        }
        if (unwritten.empty()) continue;
        Simplex::Relation elsewhere = *relations_[at];
        elsewhere.remote = true;
        elsewhere.type = info(edge(at).target).layout->type->name;
        checked_.report.error(owner(edge(at)).path(), finding::nobodyWrites, relations_[at]->place,
                              ruleText(owner(edge(at)), rule) + " has onLoss=\"" +
                                  name(rule.onLoss) + "\", but nobody writes " +
                                  listText(unwritten) + ": never changed, never lost",
                              "add the simplex that writes it; if another agent has it, remove " +
                                  unwritten.front() + " here and write " + relateText(elsewhere) +
                                  "; if people set it, give its type a settable item");
    }
}

}  // namespace

void checkUnwritten(const Checked& checked) { Flow{checked}.checkUnwritten(); }

void checkFlow(const Checked& checked) {
    Flow flow{checked};
    flow.checkWriters();
    flow.checkRemoteTypes();
    flow.checkDemands();
    flow.checkLoops();
    flow.checkLoss();
}

}  // namespace cortex
