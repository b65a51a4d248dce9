// SPDX-License-Identifier: Apache-2.0
#include "agent_model.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/type_description.hpp"

#include "ids.hpp"
#include "named_values.hpp"
#include "type_messages.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>

namespace cortex::comms {
namespace {

SimplexMessage simplexMessage(const Structure& structure, std::uint32_t index, const Image& image) {
    const SimplexInfo& info = structure.simplexes[index];
    SimplexMessage message;
    message.index = index;
    message.path = info.path;
    message.type = info.layout->type->name;
    message.typeHash = typeHash(*info.layout->type);
    message.role = name(info.role);
    message.every = info.every;
    message.phase = info.phase;
    for (std::uint32_t i = 0; i < info.edgeCount; ++i) {
        const Edge& edge = structure.edges[info.firstEdge + i];
        const SimplexInfo& target = structure.simplexes[edge.target];
        message.relationships.push_back(
            {edge.rule->name, target.path, edge.delayed, target.remote});
    }
    for (const ItemLayout& item : info.layout->items) {
        if (!item.constant) continue;
        message.constants.push_back(namedValue(item.item->name, image.value(index, item)));
    }
    return message;
}

}  // namespace

AgentModel::AgentModel(const AgentSelf& self, std::string_view security) : self_{self} {
    presence_.agent = self.id;
    presence_.name = self.name;
    presence_.host = self.host;
    presence_.epoch = self.epoch;
    presence_.role = "agent";
    presence_.majors = {1};
    presence_.security = security;
    presence_.period = self.access.period;
    addTypes();
    addSimplexes();
}

Model AgentModel::sample(const char* kind, std::string_view name) const {
    Model model;
    model.id = modelId(self_.name, kind, name);
    model.agent = self_.name;
    model.epoch = self_.epoch;
    return model;
}

Model AgentModel::sampleOf(Interest interest) const {
    Model model = sample("interest", interest.target);
    model.interests.push_back(std::move(interest));
    return model;
}

// Those of our simplexes, and all that it takes to read them.
void AgentModel::addTypes() {
    std::set<std::string> used;
    for (const SimplexInfo& info : self_.structure().simplexes) {
        used.insert(info.layout->type->name);
    }
    const std::vector<std::string> names{used.begin(), used.end()};
    std::map<std::string, TypeHash> hashes;
    for (const Type* type : closureOf(*self_.structure().types, names)) {
        samples_.push_back(sample("type", type->name));
        samples_.back().types.push_back(typeMessage(describe(*type)));
        hashes[type->name] = samples_.back().types.front().hash;
    }
    presence_.types = static_cast<std::uint32_t>(hashes.size());
    presence_.typesHash = typesHash(hashes);
}

void AgentModel::addSimplexes() {
    const Structure& structure = self_.structure();
    const Image image = self_.access.images->newest();
    if (!image) throw Error("agent " + self_.name + ": let go of an image before start()");
    std::vector<SimplexMessage> all;
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        if (structure.simplexes[i].remote) continue;
        all.push_back(simplexMessage(structure, i, image));
    }
    presence_.simplexes = static_cast<std::uint32_t>(all.size());
    presence_.structureHash = comms::structureHash(all);
    for (SimplexMessage& each : all) {
        samples_.push_back(sample("simplex", each.path));
        samples_.back().simplexes.push_back(std::move(each));
    }
}

Presence AgentModel::presence(const char* state, std::uint32_t agents) const {
    Presence presence = presence_;
    presence.extras = {{agentsHeard, std::to_string(agents)}};
    presence.state = state;
    presence.cycle = self_.access.images->newestCycle();
    return presence;
}

}  // namespace cortex::comms
