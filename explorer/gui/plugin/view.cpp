// SPDX-License-Identifier: Apache-2.0
#include "cortex/explorer/view.hpp"

#include "model/value_text.hpp"
#include "session/frame.hpp"

#include <algorithm>

namespace cortex::explorer {

SimplexNow::SimplexNow(const Frame& frame, std::string_view path) : frame_{&frame} {
    const auto place = frame.find(path);
    if (!place) return;
    agent_ = place->agent;
    simplex_ = place->simplex;
}

const Type* SimplexNow::type() const {
    return present() ? &frame_->type({agent_, simplex_}) : nullptr;
}

std::optional<State> SimplexNow::state() const {
    if (!present() || frame_->agents[agent_].lost()) return std::nullopt;
    return frame_->agents[agent_].state(simplex_);
}

Quality SimplexNow::quality() const {
    if (!present() || frame_->agents[agent_].lost()) return Quality::Lost;
    return frame_->agents[agent_].quality(simplex_);
}

std::optional<double> SimplexNow::age() const {
    if (!present()) return std::nullopt;
    return frame_->agents[agent_].age(simplex_);
}

bool SimplexNow::live() const {
    return quality() == Quality::Good && frame_->agents[agent_].status.standstill.empty();
}

std::optional<double> SimplexNow::number(std::string_view item, std::size_t element) const {
    if (!present()) return std::nullopt;
    const AgentFrame& agent = frame_->agents[agent_];
    const ItemLayout* layout = agent.structure->simplexes[simplex_].layout->find(item);
    const auto value = layout != nullptr ? agent.value(simplex_, *layout) : std::nullopt;
    return value ? numberOf(*value, element) : std::nullopt;
}

QString SimplexNow::text(std::string_view item, std::size_t element) const {
    QString nothing = QStringLiteral("—");
    if (!present()) return nothing;
    const AgentFrame& agent = frame_->agents[agent_];
    const ItemLayout* layout = agent.structure->simplexes[simplex_].layout->find(item);
    const auto value = layout != nullptr ? agent.value(simplex_, *layout) : std::nullopt;
    if (!value) return nothing;
    const QString text = elementText(*layout->item, *value, element);
    if (text.isEmpty()) return nothing;
    return live() || layout->item->constant ? text : bracketed(text);
}

const DataItem* SimplexNow::data(std::string_view item) const {
    const Type* known = type();
    if (known == nullptr) return nullptr;
    const auto found = std::ranges::find(known->data, item, &DataItem::name);
    return found == known->data.end() ? nullptr : &*found;
}

QString SimplexNow::unit(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? QString{} : unitText(found->unit);
}

std::optional<double> SimplexNow::min(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? std::nullopt : numberOf(found->min);
}

std::optional<double> SimplexNow::max(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? std::nullopt : numberOf(found->max);
}

std::vector<std::string> SimplexNow::related(std::string_view rule) const {
    std::vector<std::string> paths;
    if (!present()) return paths;
    const Structure& structure = *frame_->agents[agent_].structure;
    const SimplexInfo& info = structure.simplexes[simplex_];
    for (std::uint32_t i = info.firstEdge; i < info.firstEdge + info.edgeCount; ++i) {
        const Edge& edge = structure.edges[i];
        if (edge.rule->name == rule && edge.target != noSimplex) {
            paths.push_back(structure.simplexes[edge.target].path);
        }
    }
    return paths;
}

std::vector<std::string> SimplexNow::relatedBy(std::string_view rule) const {
    std::vector<std::string> paths;
    if (!present()) return paths;
    const std::string& path = frame_->info({agent_, simplex_}).path;
    for (const AgentFrame& agent : frame_->agents) {
        if (!agent.structure) continue;
        const Structure& structure = *agent.structure;
        for (const Edge& edge : structure.edges) {
            if (edge.rule->name == rule && edge.target != noSimplex &&
                structure.simplexes[edge.target].path == path) {
                paths.push_back(structure.simplexes[edge.owner].path);
            }
        }
    }
    return paths;
}

std::vector<std::string> SystemNow::instances(std::string_view type) const {
    std::vector<std::string> paths;
    for (const AgentFrame& agent : frame_->agents) {
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            if (!info.remote && info.layout->type->isA(type)) paths.push_back(info.path);
        }
    }
    std::ranges::sort(paths);
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    return paths;
}

void View::bind(const SystemNow& /*now*/) {}

}  // namespace cortex::explorer
