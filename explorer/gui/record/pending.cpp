// SPDX-License-Identifier: Apache-2.0
#include "record/pending.hpp"

#include "common/live_rule.hpp"
#include "common/safe_demand.hpp"
#include "record/ring.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::size_t mostTexts = 10'000;

}  // namespace

void Pending::record(std::vector<RecordedItem> items) {
    const std::lock_guard lock{mutex_};
    if (items == items_) return;
    items_ = std::move(items);
    for (auto& [name, agent] : agents_) {
        if (!agent.rows.cycles.empty()) done_.push_back(std::move(agent.rows));
    }
    agents_.clear();
}

std::vector<std::string> Pending::paths() const {
    const std::lock_guard lock{mutex_};
    std::vector<std::string> result;
    for (const RecordedItem& each : items_) result.push_back(each.path);
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
    return result;
}

Pending::Source Pending::sourceOf(const RecordedItem& item, const Structure& structure) {
    Source result;
    const std::uint32_t simplex = structure.find(item.path);
    if (simplex == noSimplex) return result;
    const TypeLayout& type = *structure.simplexes[simplex].layout;
    const ItemLayout* layout = type.find(item.item);
    if (layout == nullptr || item.element >= layout->item->length) return result;
    result.simplex = simplex;
    result.kind = layout->item->kind;
    result.offset = layout->offset + static_cast<std::uint32_t>(item.element);
    result.constant = layout->constant;
    result.always = layout->constant || common::isOfAgent(structure, simplex, item.item);
    return result;
}

Pending::Agent& Pending::agentOf(const std::string& name, const Structure& structure) {
    Agent& agent = agents_[name];
    if (agent.rows.epoch == structure.epoch && !agent.sources.empty()) return agent;
    if (!agent.rows.cycles.empty()) done_.push_back(std::move(agent.rows));
    agent = {};
    agent.rows.agent = name;
    agent.rows.epoch = structure.epoch;
    for (const RecordedItem& each : items_) {
        if (each.agent != name) continue;
        agent.rows.items.push_back(each);
        agent.sources.push_back(sourceOf(each, structure));
    }
    return agent;
}

double Pending::numberOf(const std::string& text) {
    const auto found = numbers_.find(text);
    if (found != numbers_.end()) return static_cast<double>(found->second);
    if (texts_.size() >= mostTexts) return missingValue;
    texts_.push_back(text);
    numbers_[text] = texts_.size() - 1;
    return static_cast<double>(texts_.size() - 1);
}

double Pending::number(const Image& image, const Source& source, const RecordedItem& item) {
    if (source.kind == Kind::String) {
        const ItemLayout* layout =
            image.structure().simplexes[source.simplex].layout->find(item.item);
        const Value value = image.value(source.simplex, *layout);
        const auto* texts = std::get_if<std::vector<std::string>>(&value);
        return texts != nullptr && item.element < texts->size() ? numberOf((*texts)[item.element])
                                                                : missingValue;
    }
    const Slice slice =
        source.constant ? image.constants(source.simplex) : image.slice(source.simplex);
    const void* cell = slice.at(source.kind, source.offset);
    if (source.kind == Kind::Float) return *static_cast<const double*>(cell);
    if (source.kind == Kind::Bool) return *static_cast<const bool*>(cell) ? 1 : 0;
    return static_cast<double>(*static_cast<const std::int64_t*>(cell));
}

void Pending::add(PendingRows& rows, const comms::AgentImage& image, const Source& source,
                  const RecordedItem& item) {
    double value = missingValue;
    const bool known = source.simplex != noSimplex && image.came(source.simplex);
    if (!known || (!source.constant && image.isBehind(source.simplex))) {
        rows.values.push_back(value);
        rows.qualities.push_back(Ring::notCome);
        return;
    }
    Quality quality = image->state(source.simplex).quality;
    const bool live = source.always
                          ? quality != Quality::Lost
                          : common::isSafe(source.simplex, image->state(source.simplex), image);
    if (live) quality = Quality::Good;
    if (quality == Quality::Good) value = number(*image, source, item);
    rows.values.push_back(value);
    rows.qualities.push_back(static_cast<std::uint8_t>(quality));
}

void Pending::hear(const std::string& agent, const comms::AgentImage& image,
                   std::optional<std::int64_t> came) {
    if (!image || image.lost()) return;
    const std::lock_guard lock{mutex_};
    if (std::ranges::none_of(items_, [&](const auto& each) { return each.agent == agent; })) return;
    Agent& of = agentOf(agent, image->structure());
    PendingRows& rows = of.rows;
    if (rows.values.size() + of.sources.size() > most_) {
        ++dropped_;
        return;
    }
    const auto isBehind = [&](const Source& each) {
        return !each.constant && image.isBehind(each.simplex);
    };
    if (std::ranges::all_of(of.sources, isBehind)) return;
    rows.cycles.push_back(image->cycle());
    rows.nominal.push_back(image->nominalTime());
    rows.utc.push_back(image->wallClock());
    rows.came.push_back(came.value_or(image->wallClock()));
    for (std::size_t i = 0; i < of.sources.size(); ++i) {
        add(rows, image, of.sources[i], rows.items[i]);
    }
}

std::vector<PendingRows> Pending::take() {
    const std::lock_guard lock{mutex_};
    auto result = std::exchange(done_, {});
    for (auto& [name, agent] : agents_) {
        if (agent.rows.cycles.empty()) continue;
        PendingRows next;
        next.agent = agent.rows.agent;
        next.epoch = agent.rows.epoch;
        next.items = agent.rows.items;
        result.push_back(std::exchange(agent.rows, std::move(next)));
    }
    return result;
}

std::uint64_t Pending::dropped() const {
    const std::lock_guard lock{mutex_};
    return dropped_;
}

std::vector<std::string> Pending::texts() const {
    const std::lock_guard lock{mutex_};
    return texts_;
}

}  // namespace cortex::gui
