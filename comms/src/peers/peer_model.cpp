// SPDX-License-Identifier: Apache-2.0
#include "peers/peer_model.hpp"

#include "cortex/core/simplex_tree.hpp"

#include "peers/peer_structure.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"
#include "wire/relationship_ages.hpp"
#include "wire/type_messages.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace cortex::comms {
namespace {

// Limits for one agent, so that a hostile one costs bounded memory.
constexpr std::size_t mostTypes = 16'384;
constexpr std::size_t mostSimplexes = 250'000;
constexpr std::size_t longestList = 65'536;  // bytes

template <class Map, class Message>
bool exceeds(const Map& known, const Message& name, std::size_t most) {
    return known.size() >= most && !known.contains(name);
}

std::uint32_t lacking(std::uint32_t announced, std::size_t here) {
    return here >= announced ? 0 : announced - static_cast<std::uint32_t>(here);
}

}  // namespace

PeerModel::PeerModel(std::string agent, std::int64_t epoch)
    : agent_{std::move(agent)}, epoch_{epoch} {}

bool PeerModel::refuse() {
    ++refused_;
    return false;
}

void PeerModel::changed() {
    agreed_.reset();
    built_ = false;
    structure_.reset();
    findings_ = {};
}

bool PeerModel::add(const Presence& presence) {
    const bool ours = presence.name == agent_ && presence.epoch == epoch_;
    if (!ours || presence.agent != agentId(agent_)) return refuse();
    if (presence.types > mostTypes || presence.simplexes > mostSimplexes) return refuse();
    const bool same = presence_ && presence_->types == presence.types &&
                      presence_->simplexes == presence.simplexes &&
                      presence_->typesHash == presence.typesHash &&
                      presence_->structureHash == presence.structureHash;
    presence_ = presence;
    if (!same) changed();
    return true;
}

bool PeerModel::add(const Model& model) {
    if (model.agent != agent_ || model.epoch != epoch_ || model.id != modelId(model) ||
        model.types.empty() == model.simplexes.empty()) {
        return refuse();
    }
    if (std::string shown = textIn(model, signedList); !shown.empty()) {
        if (shown.size() > longestList) return refuse();
        authority_ = std::move(shown);
    }
    std::vector<SimplexMessage> simplexes = model.simplexes;
    if (!readAges(simplexes, model.extras)) return refuse();
    bool all = true;
    for (const TypeMessage& each : model.types) all = add(each) && all;
    for (const SimplexMessage& each : simplexes) all = add(each) && all;
    return all;
}

bool PeerModel::add(const TypeMessage& type) {
    if (exceeds(types_, type.name, mostTypes)) return refuse();
    const auto [place, added] = types_.try_emplace(type.name);
    if (!added && place->second == type) return true;
    place->second = type;
    changed();
    return true;
}

bool PeerModel::add(const SimplexMessage& simplex) {
    const bool wrong = !SimplexTree::pathError(simplex.path).empty();
    if (wrong || exceeds(simplexes_, simplex.path, mostSimplexes)) return refuse();
    const auto [place, added] = simplexes_.try_emplace(simplex.path);
    if (!added && place->second == simplex) return true;
    place->second = simplex;
    changed();
    return true;
}

std::vector<std::string> PeerModel::paths() const {
    std::vector<std::string> paths;
    for (const auto& [path, simplex] : simplexes_) paths.push_back(path);
    return paths;
}

std::uint32_t PeerModel::missing() const {
    return presence_ ? missingTypes() + lacking(presence_->simplexes, simplexes_.size()) : 0;
}

std::uint32_t PeerModel::missingTypes() const {
    return presence_ ? lacking(presence_->types, types_.size()) : 0;
}

std::vector<std::string> PeerModel::missingNames() const {
    std::set<std::string> names;
    if (missingTypes() == 0) return {};
    const auto add = [&](const std::string& type) {
        if (names.size() < mostNames && !types_.contains(type)) names.insert(type);
    };
    for (const auto& [name, type] : types_) std::ranges::for_each(type.parents, add);
    for (const auto& [path, simplex] : simplexes_) add(simplex.type);
    return {names.begin(), names.end()};
}

bool PeerModel::complete() const {
    if (!presence_ || presence_->types != types_.size() ||
        presence_->simplexes != simplexes_.size()) {
        return false;
    }
    if (!agreed_) agreed_ = hashesAgree();
    return *agreed_;
}

// A tool has no types and simplexes, and no hashes of them.
bool PeerModel::hashesAgree() const {
    if (types_.empty() && simplexes_.empty()) return true;
    std::map<std::string, TypeHash> types;
    for (const auto& [name, type] : types_) types[name] = type.hash;
    if (presence_->typesHash != typesHash(types)) return false;
    std::vector<SimplexMessage> simplexes;
    for (const auto& [path, simplex] : simplexes_) simplexes.push_back(simplex);
    return presence_->structureHash == structureHash(simplexes);
}

std::shared_ptr<const Structure> PeerModel::structure() {
    if (!complete() || simplexes_.empty()) return nullptr;
    if (!std::exchange(built_, true)) build();
    return structure_;
}

std::shared_ptr<const TypeModel> PeerModel::types() {
    const auto made = structure();
    return made ? made->types : nullptr;
}

void PeerModel::build() {
    std::vector<TypeDescription> descriptions;
    for (const auto& [name, type] : types_) descriptions.push_back(typeDescription(type));
    TypeModel types = modelOf(descriptions, findings_);
    if (!findings_.ok()) return;
    auto made = buildPeerStructure(agent_, std::move(types), simplexes_, findings_);
    if (!findings_.ok()) return;
    made->epoch = epoch_;
    structure_ = std::move(made);
}

}  // namespace cortex::comms
