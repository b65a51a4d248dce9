// SPDX-License-Identifier: Apache-2.0
#include "support/small_structure.hpp"

#include <algorithm>
#include <utility>

namespace cortex::test {

namespace {

void decideWriters(Structure& structure) {
    for (const Edge& edge : structure.edges) {
        SimplexInfo& target = structure.simplexes[edge.target];
        if (edge.rule->direction == Direction::Input || target.role == Role::Active) continue;
        if (structure.simplexes[edge.owner].role != Role::Active) continue;
        target.writers.push_back(edge.owner);
        target.delayedOutput = target.delayedOutput || edge.delayed;
    }
}

}  // namespace

DataItem item(std::string name, Value initial) {
    DataItem result;
    result.name = std::move(name);
    result.kind = kindOf(initial);
    result.length = static_cast<std::uint32_t>(std::max<std::size_t>(1, lengthOf(initial)));
    result.initial = std::move(initial);
    return result;
}

Type& SmallStructure::type(std::string name, Role role, std::vector<DataItem> data) {
    Type& type = structure_->ownTypes.emplace_back();
    type.name = std::move(name);
    type.role = role;
    type.data = std::move(data);
    std::ranges::sort(type.data, {}, &DataItem::name);
    return type;
}

Rule& SmallStructure::rule(Type& owner, std::string name, Direction direction) {
    Rule& rule = structure_->ownRules.emplace_back();
    rule.name = std::move(name);
    rule.direction = direction;
    owner.rules.push_back(rule);
    return rule;
}

const TypeLayout* SmallStructure::layoutFor(const Type& type) {
    for (const auto& layout : structure_->layouts) {
        if (layout->type == &type) return layout.get();
    }
    return structure_->layouts.emplace_back(std::make_unique<TypeLayout>(typeLayout(type))).get();
}

std::uint32_t SmallStructure::add(std::string path, const Type& type) {
    SimplexInfo& added = structure_->simplexes.emplace_back();
    added.path = std::move(path);
    added.layout = layoutFor(type);
    added.role = type.role;
    return static_cast<std::uint32_t>(structure_->simplexes.size() - 1);
}

void SmallStructure::relate(std::uint32_t owner, const Rule& rule, std::uint32_t target,
                            bool delayed) {
    SimplexInfo& from = info(owner);
    if (from.edgeCount++ == 0) {
        from.firstEdge = static_cast<std::uint32_t>(structure_->edges.size());
    }
    structure_->edges.push_back({owner, target, &rule, delayed});
}

void SmallStructure::set(std::uint32_t simplex, std::string_view name, Value value) {
    structure_->initial.push_back({simplex, info(simplex).layout->find(name), std::move(value)});
}

std::shared_ptr<const Structure> SmallStructure::build() {
    structure_->agent = "robot";
    for (SimplexInfo& each : structure_->simplexes) {
        each.base = structure_->cyclic;
        each.constantBase = structure_->constant;
        structure_->cyclic += each.layout->cyclic;
        structure_->constant += each.layout->constant;
    }
    structure_->indexPaths();
    decideWriters(*structure_);
    return structure_;
}

Plant makePlant() {
    SmallStructure model;
    DataItem label = item("label", std::vector<std::string>{"axis"});
    label.capacity = 8;
    DataItem names = item("names", std::vector<std::string>{"a", "b"});
    names.capacity = 4;
    DataItem origin = item("origin", std::vector{0.1, 0.2, 0.3});
    origin.constant = true;
    DataItem serial = item("serial", std::vector<std::string>{"S1"});
    serial.constant = true;
    const std::vector<DataItem> data{item("position", std::vector{0.5}),
                                     item("torques", std::vector{1.0, 2.0, 3.0}),
                                     item("mode", std::vector<std::int64_t>{7}),
                                     item("on", std::vector<bool>{true}),
                                     label,
                                     names,
                                     origin,
                                     serial};
    Type& axis = model.type("Axis", Role::Descriptive, data);
    Type& shared = model.type("SharedAxis", Role::Modification, data);
    shared.manyWriters = true;
    Type& driver = model.type("Driver", Role::Active, {item("gain", std::vector{2.0})});
    const Rule& output = model.rule(driver, "axis", Direction::Output);
    const Rule& input = model.rule(driver, "seen", Direction::Input);
    Rule& hold = model.rule(driver, "held", Direction::Input);
    hold.onLoss = OnLoss::Hold;
    const Rule& order = model.rule(driver, "order", Direction::Output);

    Plant plant{};
    plant.axis = model.add("/axis", axis);
    plant.first = model.add("/first", driver);
    plant.reader = model.add("/reader", driver);
    plant.second = model.add("/second", driver);
    plant.shared = model.add("/shared", shared);
    plant.remote = model.add("/other/axis", axis);
    model.info(plant.remote).remote = true;

    std::uint32_t edges = 0;
    const auto relate = [&](std::uint32_t owner, const Rule& rule, std::uint32_t target,
                            bool delayed) {
        model.relate(owner, rule, target, delayed);
        return edges++;
    };
    plant.axisWritten = relate(plant.first, output, plant.axis, true);
    plant.firstShared = relate(plant.first, output, plant.shared, false);
    plant.latched = relate(plant.reader, input, plant.axis, false);
    plant.live = relate(plant.reader, input, plant.shared, false);
    plant.held = relate(plant.reader, hold, plant.shared, false);
    plant.heldDelayed = relate(plant.reader, hold, plant.axis, false);
    plant.remoteRead = relate(plant.reader, input, plant.remote, false);
    plant.secondShared = relate(plant.second, output, plant.shared, false);
    plant.activeLive = relate(plant.second, order, plant.first, false);
    plant.activeDelayed = relate(plant.second, input, plant.first, true);
    model.set(plant.axis, "position", std::vector{1.25});
    model.set(plant.axis, "origin", std::vector{4.0, 5.0, 6.0});
    plant.structure = model.build();
    return plant;
}

}  // namespace cortex::test
