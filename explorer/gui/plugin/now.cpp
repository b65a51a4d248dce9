// SPDX-License-Identifier: Apache-2.0
#include "cortex/explorer/now.hpp"

#include "model/value_text.hpp"
#include "session/frame.hpp"

#include <algorithm>

namespace cortex::explorer {

using gui::AgentFrame;
using gui::Frame;

SimplexNow::SimplexNow(const Frame& frame, std::string_view path) : frame_{&frame} {
    const auto place = frame.find(path);
    if (!place) return;
    agent_ = place->agent;
    simplex_ = place->simplex;
}

SimplexNow::SimplexNow(const Frame& frame, const Handle& handle) : frame_{&frame} {
    if (handle.structures_ != frame.structures) return;
    agent_ = handle.agent_;
    simplex_ = handle.simplex_;
}

Handle SimplexNow::handle() const {
    Handle handle;
    handle.structures_ = frame_->structures;
    handle.agent_ = agent_;
    handle.simplex_ = simplex_;
    return handle;
}

Number SimplexNow::find(std::string_view item, std::size_t element) const {
    Number number;
    if (!present()) return number;
    number.structures_ = frame_->structures;
    number.agent_ = agent_;
    number.simplex_ = simplex_;
    number.item_ = frame_->info({agent_, simplex_}).layout->find(item);
    number.element_ = element;
    return number;
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

bool SimplexNow::live() const { return present() && frame_->agents[agent_].live(simplex_); }

std::optional<double> SimplexNow::number(std::string_view item, std::size_t element) const {
    if (!present()) return std::nullopt;
    const AgentFrame& agent = frame_->agents[agent_];
    const ItemLayout* layout = agent.structure->simplexes[simplex_].layout->find(item);
    const auto value = layout != nullptr ? agent.value(simplex_, *layout) : std::nullopt;
    return value ? gui::numberOf(*value, element) : std::nullopt;
}

QString SimplexNow::text(std::string_view item, std::size_t element) const {
    QString nothing = QStringLiteral("—");
    if (!present()) return nothing;
    const AgentFrame& agent = frame_->agents[agent_];
    const ItemLayout* layout = agent.structure->simplexes[simplex_].layout->find(item);
    const auto value = layout != nullptr ? agent.value(simplex_, *layout) : std::nullopt;
    if (!value) return nothing;
    const QString text = gui::elementText(*layout->item, *value, element);
    if (text.isEmpty()) return nothing;
    return agent.live(simplex_, *layout->item) ? text : gui::bracketed(text);
}

const DataItem* SimplexNow::data(std::string_view item) const {
    const Type* known = type();
    if (known == nullptr) return nullptr;
    const auto found = std::ranges::find(known->data, item, &DataItem::name);
    return found == known->data.end() ? nullptr : &*found;
}

QString SimplexNow::unit(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? QString{} : gui::unitText(found->unit);
}

std::optional<double> SimplexNow::min(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? std::nullopt : gui::numberOf(found->min);
}

std::optional<double> SimplexNow::max(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? std::nullopt : gui::numberOf(found->max);
}

std::optional<double> SimplexNow::rate(std::string_view item) const {
    const DataItem* found = data(item);
    return found == nullptr ? std::nullopt : found->rate;
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

std::uint64_t SystemNow::moment() const { return frame_->number; }

std::int64_t SystemNow::utc() const { return frame_->utc; }

std::optional<double> SystemNow::number(const Number& number) const {
    if (number.structures_ != frame_->structures || number.item_ == nullptr) return std::nullopt;
    const auto value = frame_->agents[number.agent_].value(number.simplex_, *number.item_);
    return value ? gui::numberOf(*value, number.element_) : std::nullopt;
}

std::optional<std::string> SystemNow::deviceOf(std::string_view path) const {
    const SimplexNow simplex = at(path);
    for (const char* rule : {"demand", "demands", "observation", "observations"}) {
        for (const std::string& each : simplex.relatedBy(rule)) {
            const Type* type = at(each).type();
            if (type != nullptr && type->isA("Device")) return each;
        }
    }
    return std::nullopt;
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

}  // namespace cortex::explorer
