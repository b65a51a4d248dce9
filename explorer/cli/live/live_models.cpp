// SPDX-License-Identifier: Apache-2.0
#include "live/live_models.hpp"

#include "cortex/core/type_description.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace cortex::cli {
namespace {

using Structures = std::vector<std::shared_ptr<const Structure>>;

// What a merged structure consists of lies in those of the agents.
struct Merged {
    Structure structure;
    Structures keeps;
};

struct Member {
    const Structure* structure = nullptr;
    std::uint32_t simplex = noSimplex;
};

// Own simplexes by path, then what no agent has but somebody is joined to.
std::vector<std::pair<std::string, Member>> membersOf(const Live& live, Merged& merged) {
    std::map<std::string, Member> own, remote;
    for (const FoundSimplex& each : live.below("/")) {
        const bool kept = std::ranges::count(merged.keeps, each.structure) > 0;
        if (!kept) merged.keeps.push_back(each.structure);
        const bool owner = live.ownerOf(each.info().path) == each.agent;
        if (owner) own[each.info().path] = {each.structure.get(), each.index};
    }
    for (const auto& structure : merged.keeps) {
        for (std::uint32_t i = 0; i < structure->simplexes.size(); ++i) {
            const SimplexInfo& info = structure->simplexes[i];
            if (!own.contains(info.path)) remote.try_emplace(info.path, Member{structure.get(), i});
        }
    }
    std::vector<std::pair<std::string, Member>> members{own.begin(), own.end()};
    members.insert(members.end(), remote.begin(), remote.end());
    return members;
}

// The relationships and writers of one simplex, by their new indexes.
void join(Merged& merged, std::uint32_t simplex, const Member& member) {
    const SimplexInfo& old = member.structure->simplexes[member.simplex];
    const auto indexOf = [&](std::uint32_t other) {
        return merged.structure.find(member.structure->simplexes[other].path);
    };
    SimplexInfo& info = merged.structure.simplexes[simplex];
    info.writers.clear();
    info.firstEdge = static_cast<std::uint32_t>(merged.structure.edges.size());
    if (info.remote) {
        info.edgeCount = 0;
        return;
    }
    for (const std::uint32_t each : old.writers) info.writers.push_back(indexOf(each));
    for (std::uint32_t i = 0; i < old.edgeCount; ++i) {
        Edge edge = member.structure->edges[old.firstEdge + i];
        edge.owner = simplex;
        edge.target = indexOf(edge.target);
        merged.structure.edges.push_back(edge);
    }
}

}  // namespace

TypeModel typesOf(Live& live) {
    std::map<std::string, TypeDescription> types;
    std::map<std::string, std::string> sources;
    std::set<std::string> differing;
    for (const comms::AgentStatus& agent : live.mirror().agents()) {
        const auto structure = live.mirror().structure(agent.name);
        if (!structure) continue;
        for (const auto& [typeName, type] : structure->types->types()) {
            const TypeDescription description = describe(type);
            const auto [found, added] = types.try_emplace(typeName, description);
            if (added) sources[typeName] = agent.name;
            if (added || found->second.hash == description.hash) continue;
            differing.insert(typeName + " (shown as " + sources[typeName] + " has it, " +
                             agent.name + " differs)");
        }
    }
    std::vector<TypeDescription> all;
    for (const auto& [typeName, description] : types) all.push_back(description);
    Report report;
    TypeModel model = modelOf(all, report);
    for (const std::string& each : differing) {
        report.warning("", "type-differs", {}, "agents have different types " + each);
    }
    printFindings(report, Stream::Errors);
    return model;
}

Graph graphOf(Live& live) {
    const auto merged = std::make_shared<Merged>();
    const auto members = membersOf(live, *merged);
    std::vector<std::string> agents;
    for (const auto& [path, member] : members) {
        SimplexInfo info = member.structure->simplexes[member.simplex];
        agents.push_back(info.remote ? "" : member.structure->agent);
        merged->structure.simplexes.push_back(std::move(info));
    }
    merged->structure.indexPaths();
    for (std::uint32_t i = 0; i < members.size(); ++i) join(*merged, i, members[i].second);
    std::vector<std::string> names;
    std::set<std::string> lost;
    for (const comms::AgentStatus& each : live.mirror().agents()) {
        names.push_back(each.name);
        if (each.state == "lost") lost.insert(each.name);
    }
    const std::shared_ptr<const Structure> structure{merged, &merged->structure};
    return makeGraph(joined(names, " "), structure, std::move(agents), std::move(lost));
}

}  // namespace cortex::cli
