// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/value.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace cortex::gui {

// A number to its last digit, also a whole one that no double has. What is no number has no place
// in an order, so it is never one of these; the infinities are.
class ExactNumber {
public:
    explicit ExactNumber(double number) : near_{number} {}
    explicit ExactNumber(std::int64_t number);
    explicit ExactNumber(const Number& number);

    double near() const { return near_; }  // the nearest double
    bool isWhole() const { return whole_; }
    std::string text() const;  // plain ASCII that reads back equal

    // Two int64 never have a difference that this has not.
    ExactNumber operator-(const ExactNumber& other) const;
    bool operator<(const ExactNumber& other) const;
    bool operator==(const ExactNumber& other) const;

private:
    ExactNumber(bool negative, std::uint64_t size);
    std::int64_t rest() const;

    double near_ = 0;
    std::uint64_t size_ = 0;  // of a whole one, without its sign
    bool negative_ = false, whole_ = false;
};

// None: the element is no number, or has that as its value.
std::optional<ExactNumber> exactOf(const Value& value, std::size_t element = 0);

}  // namespace cortex::gui
