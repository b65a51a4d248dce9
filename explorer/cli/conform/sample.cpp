// SPDX-License-Identifier: Apache-2.0
#include "conform/sample.hpp"

#include <cmath>

namespace cortex::cli::conform {
namespace {

// Of the agent's own simplex, which has dozens of metrics.
constexpr std::string_view neededOfAgent = "latenessMax";
constexpr double greatestCount = 9007199254740992;  // 2^53: up to there each is a number of its own

bool isNeeded(const Type& type, const DataItem& item) {
    if (item.constant || item.kind == Kind::String) return false;
    return !type.isA("Agent") || item.name == neededOfAgent;
}

}  // namespace

std::vector<double> numbersOf(const Value& value) {
    std::vector<double> numbers;
    if (const auto* floats = std::get_if<std::vector<double>>(&value)) return *floats;
    if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value)) {
        for (const std::int64_t each : *ints) numbers.push_back(static_cast<double>(each));
    } else if (const auto* bools = std::get_if<std::vector<bool>>(&value)) {
        for (const bool each : *bools) numbers.push_back(each ? 1 : 0);
    }
    return numbers;
}

SampleLayout::SampleLayout(const Structure& structure,
                           const std::vector<std::uint32_t>& simplexes) {
    std::size_t place = 0;
    for (const std::uint32_t simplex : simplexes) {
        const TypeLayout& layout = *structure.simplexes[simplex].layout;
        Part part{simplex, {}, {}};
        for (const ItemLayout& each : layout.items) {
            if (!isNeeded(*layout.type, *each.item)) continue;
            part.items.push_back(&each);
            part.places.emplace(each.item->name, Place{place, each.item->length});
            place += each.item->length;
        }
        partOf.emplace(simplex, parts.size());
        parts.push_back(std::move(part));
    }
}

Sample::Sample(std::shared_ptr<const SampleLayout> layout, const Image& image)
    : cycle{image.cycle()}, time{image.nominalTime()}, layout_{std::move(layout)} {
    for (const SampleLayout::Part& part : layout_->parts) {
        slots_.push_back(image.state(part.simplex));
        for (const ItemLayout* item : part.items) {
            const auto numbers = numbersOf(image.value(part.simplex, *item));
            numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
        }
    }
}

std::optional<double> Sample::number(std::uint32_t simplex, std::string_view item,
                                     std::size_t element) const {
    const auto part = layout_->partOf.find(simplex);
    if (part == layout_->partOf.end()) return {};
    const auto& places = layout_->parts[part->second].places;
    const auto place = places.find(item);
    if (place == places.end() || element >= place->second.length) return {};
    return numbers_.at(place->second.first + element);
}

// Items of these names may be anything in a type of somebody else's.
std::int64_t Sample::count(std::uint32_t simplex, std::string_view item,
                           std::size_t element) const {
    const double number = at(simplex, item, element);
    return std::abs(number) < greatestCount ? static_cast<std::int64_t>(number) : 0;
}

State Sample::stateOf(std::uint32_t simplex) const {
    const std::int64_t number = count(simplex, "state");
    return number >= 0 && number < stateCount ? static_cast<State>(number) : State::Fault;
}

const SlotState& Sample::slot(std::uint32_t simplex) const {
    return slots_.at(layout_->partOf.at(simplex));
}

}  // namespace cortex::cli::conform
