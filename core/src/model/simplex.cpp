// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/simplex.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <utility>

namespace cortex {

namespace {

// A setting written as whole numbers in code fits a float item too.
Value fitted(const Type& type, std::string_view item, Value value) {
    const DataItem* data = type.findData(item);
    const auto* numbers = std::get_if<std::vector<std::int64_t>>(&value);
    if (data == nullptr || data->kind != Kind::Float || numbers == nullptr) return value;
    std::vector<double> floats;
    for (const std::int64_t number : *numbers) floats.push_back(static_cast<double>(number));
    return floats;
}

}  // namespace

Simplex::Simplex(Identity identity)
    : description_{std::make_unique<Description>(Description{std::move(identity)})} {}

Simplex::~Simplex() = default;

void Simplex::set(std::string_view item, const GivenValue& value, Place place) {
    std::vector<Setting>& settings = description_->settings;
    const auto same = std::ranges::find(settings, item, &Setting::item);
    Setting& setting = same != settings.end() ? *same : settings.emplace_back();
    setting = {std::string{item}, fitted(type(), item, value), std::move(place)};
}

void Simplex::runEvery(int cycles, int phase) {
    if (cycles < 1 || phase < -1 || phase >= cycles) {
        throw Error(path() + ": every must be 1 or more, phase from 0 to every - 1");
    }
    description_->every = cycles;
    description_->phase = phase;
}

}  // namespace cortex
