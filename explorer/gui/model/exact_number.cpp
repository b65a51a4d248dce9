// SPDX-License-Identifier: Apache-2.0
#include "model/exact_number.hpp"

#include <cmath>
#include <variant>

namespace cortex::gui {

namespace {

std::uint64_t sizeOf(std::int64_t number) {
    const auto size = static_cast<std::uint64_t>(number);
    return number < 0 ? 0 - size : size;
}

}  // namespace

ExactNumber::ExactNumber(bool negative, std::uint64_t size)
    : near_{negative ? -static_cast<double>(size) : static_cast<double>(size)},
      size_{size},
      negative_{negative},
      whole_{true} {}

ExactNumber::ExactNumber(std::int64_t number) : ExactNumber{number < 0, sizeOf(number)} {}

ExactNumber::ExactNumber(const Number& number)
    : ExactNumber{std::visit([](auto plain) { return ExactNumber{plain}; }, number)} {}

std::string ExactNumber::text() const {
    return whole_ ? (negative_ ? "-" : "") + std::to_string(size_) : toText(near_);
}

// What it is more than its nearest double. That may be 2^64, which is 0 in 64 bits.
std::int64_t ExactNumber::rest() const {
    constexpr double beyond = 0x1p64;
    if (!whole_) return 0;
    const double near = std::abs(near_);
    const std::uint64_t base = near < beyond ? static_cast<std::uint64_t>(near) : 0;
    const auto rest = static_cast<std::int64_t>(size_ - base);
    return negative_ ? -rest : rest;
}

ExactNumber ExactNumber::operator-(const ExactNumber& other) const {
    if (!whole_ || !other.whole_) return ExactNumber{near_ - other.near_};
    if (negative_ != other.negative_) return {negative_, size_ + other.size_};
    if (size_ < other.size_) return {!negative_, other.size_ - size_};
    return {negative_ && size_ != other.size_, size_ - other.size_};
}

bool ExactNumber::operator<(const ExactNumber& other) const {
    return near_ != other.near_ ? near_ < other.near_ : rest() < other.rest();
}

bool ExactNumber::operator==(const ExactNumber& other) const {
    return near_ == other.near_ && rest() == other.rest();
}

std::optional<ExactNumber> exactOf(const Value& value, std::size_t element) {
    if (element >= lengthOf(value)) return std::nullopt;
    if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value))
        return ExactNumber{(*ints)[element]};
    const auto* floats = std::get_if<std::vector<double>>(&value);
    if (floats == nullptr || std::isnan((*floats)[element])) return std::nullopt;
    return ExactNumber{(*floats)[element]};
}

}  // namespace cortex::gui
