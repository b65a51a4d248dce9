// SPDX-License-Identifier: Apache-2.0
#include "conform/plant.hpp"

#include <algorithm>
#include <set>

namespace cortex::cli::conform {
namespace {

bool isOrRefines(const Type& type, const Rule& rule, std::string_view wanted) {
    const Rule* each = &rule;
    while (each != nullptr && each->name != wanted) {
        each = each->refines.empty() ? nullptr : type.findRule(each->refines);
    }
    return each != nullptr;
}

bool contains(const std::vector<std::uint32_t>& all, std::uint32_t simplex) {
    return std::ranges::find(all, simplex) != all.end();
}

std::uint32_t agentsOwn(const Structure& structure) {
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (!info.remote && info.layout->type->isA("Agent")) return i;
    }
    return noSimplex;
}

[[noreturn]] void failWithNoDevice(const FoundSimplex& simplex) {
    std::vector<std::string> devices;
    for (const SimplexInfo& each : simplex.structure->simplexes) {
        if (!each.remote && each.layout->type->isA("Device")) devices.push_back(each.path);
    }
    const std::string there = devices.empty() ? "has no device" : "has " + joined(devices);
    throw Failure{NotFound, simplex.info().path + " (" + simplex.type().name +
                                ") is no Device; agent " + simplex.agent + " " + there};
}

// A processor leads one or two drives; only those of this device count.
void findProcessor(Plant& plant) {
    for (std::uint32_t i = 0; i < plant.structure->simplexes.size(); ++i) {
        if (plant.info(i).remote || !plant.type(i).isA("Ds402Processor")) continue;
        const auto drives = plant.related(i, "drives"), demands = plant.related(i, "demands");
        for (std::size_t place = 0; place < std::min(drives.size(), demands.size()); ++place) {
            if (!contains(plant.observations, drives[place])) continue;
            plant.processor = i;
            plant.axes.push_back({demands[place], drives[place], place});
        }
        if (plant.processor) return;
    }
}

// The n-th axis that is demanded is the n-th that is observed, among what else the device has.
void findAxes(Plant& plant) {
    const auto axesOf = [&](std::vector<std::uint32_t> all) {
        std::erase_if(all,
                      [&](std::uint32_t each) { return !plant.type(each).isA("AxisConcept"); });
        return all;
    };
    const auto demands = axesOf(plant.demands), observations = axesOf(plant.observations);
    for (std::size_t i = 0; i < std::min(demands.size(), observations.size()); ++i) {
        plant.axes.push_back({demands[i], observations[i], i});
    }
}

std::optional<Mover::Kind> kindOf(const Type& controller) {
    if (controller.isA("AxisPoseController")) return Mover::Poses;
    if (controller.isA("JogController")) return Mover::Jogs;
    if (controller.isA("GripperController")) return Mover::Grips;
    return std::nullopt;
}

}  // namespace

bool Plant::hasAxes() const {
    return !axes.empty() || deviceIs("AxisDevice") || deviceIs("Ds402Device");
}

bool Plant::isGripper() const {
    return std::ranges::any_of(axes, [&](const AxisPair& axis) {
        return std::ranges::any_of(movers(axis),
                                   [](const Mover& each) { return each.kind == Mover::Grips; });
    });
}

std::vector<std::uint32_t> Plant::all() const {
    std::vector<std::uint32_t> all{device};
    all.insert(all.end(), demands.begin(), demands.end());
    all.insert(all.end(), observations.begin(), observations.end());
    return all;
}

std::vector<std::uint32_t> Plant::related(std::uint32_t owner, std::string_view rule) const {
    std::vector<std::uint32_t> targets;
    for (std::uint32_t i = 0; i < info(owner).edgeCount; ++i) {
        const Edge& edge = structure->edges[info(owner).firstEdge + i];
        if (edge.rule != nullptr && isOrRefines(type(owner), *edge.rule, rule))
            targets.push_back(edge.target);
    }
    return targets;
}

std::vector<Mover> Plant::movers(const AxisPair& axis) const {
    std::vector<Mover> movers;
    for (const std::uint32_t writer : info(axis.demand).writers) {
        const auto kind = kindOf(type(writer));
        const auto its = related(writer, "demands");
        const auto found = std::ranges::find(its, axis.demand);
        if (!kind || found == its.end()) continue;
        movers.push_back({writer, static_cast<std::size_t>(found - its.begin()), *kind});
    }
    return movers;
}

std::vector<std::uint32_t> Plant::followed() const {
    std::set<std::uint32_t> followed;
    for (const std::uint32_t each : all()) followed.insert(each);
    if (cluster != noSimplex) followed.insert(cluster);
    if (processor) {
        followed.insert(*processor);
        for (const std::uint32_t each : related(*processor, "setpoints")) followed.insert(each);
    }
    for (const AxisPair& axis : axes) {
        followed.insert({axis.demand, axis.observation});
        for (const std::uint32_t writer : info(axis.demand).writers) followed.insert(writer);
        for (const Mover& mover : movers(axis)) {
            for (const std::uint32_t each : related(mover.controller, "demands"))
                followed.insert(each);
        }
    }
    return {followed.begin(), followed.end()};
}

Plant findPlant(Live& live, const std::string& path) {
    const FoundSimplex found = live.find(path);
    if (!found.type().isA("Device")) failWithNoDevice(found);
    Plant plant;
    plant.agent = found.agent;
    plant.structure = found.structure;
    plant.device = found.index;
    plant.cluster = agentsOwn(*plant.structure);
    plant.demands = plant.related(found.index, "demands");
    plant.observations = plant.related(found.index, "observations");
    if (plant.deviceIs("Ds402Device"))
        findProcessor(plant);
    else
        findAxes(plant);
    return plant;
}

}  // namespace cortex::cli::conform
