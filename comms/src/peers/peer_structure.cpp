// SPDX-License-Identifier: Apache-2.0
#include "peers/peer_structure.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/agreement.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/make_structure.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "wire/named_values.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::uint64_t mostOctets = 256U << 20U;  // of all values of an agent
constexpr std::uint32_t mostEvery = 1'000'000;

// Makes a tree of the simplexes that an agent describes, and the structure of that tree.
class PeerStructure {
public:
    PeerStructure(const std::string& agent, TypeModel types, Report& report)
        : agent_{agent}, tree_{std::move(types)}, report_{report} {}

    std::shared_ptr<Structure> build(const std::map<std::string, SimplexMessage>& simplexes) {
        for (const auto& [path, message] : simplexes) add(message);
        if (!report_.ok()) return nullptr;
        for (const auto& [path, message] : simplexes) complete(tree_.at(path), message);
        if (!report_.ok()) return nullptr;
        try {
            auto structure = makeStructure(agent_, tree_);
            check(*structure, simplexes);
            return structure;
        } catch (const ModelError& tooLarge) {
            report_.append(tooLarge.report());
            return nullptr;
        }
    }

private:
    void error(const std::string& path, std::string message) {
        report_.error(path, "peer", {}, "agent " + agent_ + ": " + std::move(message));
    }

    void add(const SimplexMessage& message) {
        const Type* type = tree_.types().find(message.type);
        if (type == nullptr) return error(message.path, "its type " + message.type + " is missing");
        if (typeHash(*type) != message.typeHash) {
            return error(message.path, "its type " + message.type + " is not the one published");
        }
        if (message.every == 0 || message.every > mostEvery) {
            return error(message.path, "runs every " + std::to_string(message.every) + " cycles");
        }
        try {
            const auto every = static_cast<int>(message.every);
            tree_.add(message.path, message.type).runEvery(every, message.phase);
        } catch (const Error& refused) {
            error(message.path, refused.what());
        }
    }

    void complete(Simplex& simplex, const SimplexMessage& message) {
        for (const Relationship& each : message.relationships) relate(simplex, each);
        for (const NamedValue& each : message.constants) setConstant(simplex, each);
    }

    void relate(Simplex& simplex, const Relationship& relationship) {
        const auto wrong = [&](const char* why) {
            error(simplex.path(),
                  "rule '" + relationship.rule + "' to " + relationship.target + ": " + why);
        };
        const Rule* rule = simplex.type().findRule(relationship.rule);
        const Simplex* target = tree_.find(relationship.target);
        if (rule == nullptr) return wrong("its type has no such rule");
        if (!relationship.remote) {
            if (target == nullptr) return wrong("there is no such simplex");
            return tree_.relate(simplex, relationship.rule, *target, relationship.delayed,
                                relationship.maxAge);
        }
        if (target != nullptr) return wrong("it is no simplex of another agent");
        if (rule->direction != Direction::Input) return wrong("other agents' can only be inputs");
        if (!SimplexTree::pathError(relationship.target).empty()) return wrong("it is no path");
        tree_.relateRemote(simplex, relationship.rule, relationship.target, {},
                           relationship.delayed, relationship.maxAge);
    }

    void setConstant(Simplex& simplex, const NamedValue& named) {
        const DataItem* item = simplex.type().findData(named.name);
        const auto value = valueOf(named);
        if (item == nullptr || !item->constant || !value || kindOf(*value) != item->kind ||
            lengthOf(*value) != item->length) {
            return error(simplex.path(), "constant '" + named.name + "' does not fit its type");
        }
        simplex.set(named.name, *value);
    }

    void check(const Structure& structure, const std::map<std::string, SimplexMessage>& simplexes) {
        std::uint64_t octets = 0;
        for (const SimplexInfo& info : structure.simplexes) {
            const BlockSizes& sizes = info.layout->cyclic;
            octets += (std::uint64_t{sizes.ints} + sizes.floats) * 8 + sizes.bools + sizes.strings;
        }
        if (octets > mostOctets) error("", "its values are too large to be mirrored");
        std::uint32_t index = 0;
        for (const auto& [path, message] : simplexes) {
            const SimplexInfo& info = structure.simplexes[index];
            if (message.index != index || message.role != name(info.role) ||
                info.edgeCount != message.relationships.size()) {
                error(path, "index, role or relationships are not those that its model makes");
            }
            ++index;
        }
    }

    const std::string& agent_;
    SimplexTree tree_;
    Report& report_;
};

}  // namespace

std::shared_ptr<Structure> buildPeerStructure(
    const std::string& agent, TypeModel types,
    const std::map<std::string, SimplexMessage>& simplexes, Report& report) {
    return PeerStructure{agent, std::move(types), report}.build(simplexes);
}

}  // namespace cortex::comms
