// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// Canonical text of a type (docs/protocol.md) and the first 16 bytes of its SHA-256. Two agents
// with equal hashes mean the same; unequal ones are compared item by item.
using TypeHash = std::array<std::uint8_t, 16>;

TypeHash hashOf(std::string_view text);
std::string canonicalText(const Type& type);
TypeHash typeHash(const Type& type);
std::string toHex(const TypeHash& hash);

struct Disagreement {
    std::string type;
    std::string item;          // "position", "command zero", "rule axes", or "" for the type itself
    std::string ours, theirs;  // as text, "" where one side lacks it
    // A contradiction cuts the link; a difference (range, default, …) is listed and linked.
    bool contradiction = false;

    std::string text() const;
};

std::vector<Disagreement> compare(const Type& ours, const Type& theirs);
// All types that both models have; a type that only one side knows is no disagreement.
std::vector<Disagreement> compare(const TypeModel& ours, const TypeModel& theirs);

}  // namespace cortex
