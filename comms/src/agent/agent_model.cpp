// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_model.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/sending_checks.hpp"
#include "cortex/core/type_description.hpp"

#include "wire/cdr.hpp"
#include "wire/ids.hpp"
#include "wire/named_values.hpp"
#include "wire/presence_extras.hpp"
#include "wire/relationship_ages.hpp"
#include "wire/type_messages.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t fullSample = 1'200;  // bytes: one packet, so that a lost one costs no other

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
        message.relationships.push_back({edge.rule->name, target.path, edge.delayed, target.remote,
                                         edge.maxAge == edge.rule->maxAge ? 0 : edge.maxAge});
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

// Packs the messages into as few samples as they fill.
template <class Message>
void AgentModel::pack(std::vector<Message>&& messages, std::vector<Message> Model::* list) {
    std::size_t size = fullSample;
    for (Message& each : messages) {
        Model alone;
        alone.agent = self_.name;
        alone.epoch = self_.epoch;
        (alone.*list).push_back(std::move(each));
        writeAges(alone);
        const std::size_t more = encodedSize(alone);
        if (size + more > fullSample) {
            alone.id = modelId(alone);
            samples_.push_back(std::move(alone));
            size = more;
        } else {
            (samples_.back().*list).push_back(std::move((alone.*list).front()));
            std::ranges::move(alone.extras, std::back_inserter(samples_.back().extras));
            size += more;
        }
    }
}

// Adds the types of all simplexes, and those that a reader needs to understand them.
void AgentModel::addTypes() {
    std::set<std::string> used;
    for (const SimplexInfo& info : self_.structure().simplexes) {
        used.insert(info.layout->type->name);
    }
    const std::vector<std::string> names{used.begin(), used.end()};
    std::map<std::string, TypeHash> hashes;
    std::vector<TypeMessage> all;
    std::vector<TypeDescription> described;
    for (const Type* type : closureOf(*self_.structure().types, names)) {
        described.push_back(describe(*type));
        all.push_back(typeMessage(described.back()));
        hashes[type->name] = all.back().hash;
    }
    Report report = checkDescribed(*self_.structure().types, described);
    if (!report.ok()) throw ModelError{std::move(report)};
    pack(std::move(all), &Model::types);
    presence_.types = static_cast<std::uint32_t>(hashes.size());
    presence_.typesHash = typesHash(hashes);
}

void AgentModel::addSimplexes() {
    const Structure& structure = self_.structure();
    const Image image = self_.access.newestImage();
    if (!image) throw Error("agent " + self_.name + ": let go of an image before start()");
    std::vector<SimplexMessage> all;
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        if (structure.simplexes[i].remote) continue;
        all.push_back(simplexMessage(structure, i, image));
    }
    presence_.simplexes = static_cast<std::uint32_t>(all.size());
    presence_.structureHash = comms::structureHash(all);
    pack(std::move(all), &Model::simplexes);
}

void AgentModel::show(const std::string& list) {
    if (!samples_.empty()) samples_.front().extras.push_back({signedList, list});
}

Presence AgentModel::presence(const char* state, std::uint32_t agents, std::uint64_t events) const {
    Presence presence = presence_;
    presence.extras = {{agentsHeard, std::to_string(agents)},
                       {eventsWritten, std::to_string(events)}};
    presence.state = state;
    presence.cycle = self_.access.newestCycle();
    return presence;
}

}  // namespace cortex::comms
