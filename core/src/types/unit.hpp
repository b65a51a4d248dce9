// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cortex {

// What a type writes that leaves the unit of an item to its children; it is no unit.
inline constexpr std::string_view openUnit = "*";

// Exponents of metre, kilogram, second, radian, kelvin, ampere, candela, mole and bit.
using Dimension = std::array<std::int16_t, 9>;

// A unit of the subset of UCUM in docs/ontology.md: "1", or symbols with an optional metric prefix
// and an exponent, joined by '.' and '/'. Two texts mean the same where the canonical ones are
// equal.
struct Unit {
    std::string canonical;  // factors sorted, those above the line first: "N.m/s2"
    Dimension dimension{};
};

// On failure empty, and `why` says what is wrong with the nearest valid symbols.
std::optional<Unit> parseUnit(std::string_view text, std::string& why);

}  // namespace cortex
