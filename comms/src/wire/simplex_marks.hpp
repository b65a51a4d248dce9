// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/simplex_mark.hpp"
#include "cortex/core/structure.hpp"
#include "cortex/core/tables.hpp"

#include <cstdint>
#include <optional>
#include <vector>

// How a simplex is, in one octet: bits 0-1 its quality, bits 2-4 its state and 1 (0: it has none),
// bit 5 whether a value is outside its limits. Later versions may use the others.
namespace cortex::comms {

std::uint8_t octetOf(const SimplexMark& mark);
std::optional<SimplexMark> markOf(std::uint8_t octet);  // none: no such state

// Whether values of an item can be outside its limits; constants never are.
bool isLimited(const ItemLayout& each);
// Whether this element is outside them. What is no number never is.
bool isOutside(const ItemLayout& each, const Slice& slice, std::uint32_t element);

// Finds out how the simplexes of a structure are, which outlives it. It allocates nothing.
class SimplexMarks {
public:
    explicit SimplexMarks(const Structure& structure);

    SimplexMark of(std::uint32_t simplex, const Slice& slice) const;

private:
    // What is looked at in the simplexes of one type.
    struct Looked {
        const ItemLayout* state = nullptr;
        std::vector<const ItemLayout*> limited;
    };

    std::vector<Looked> layouts_;
    std::vector<std::uint32_t> looked_;  // by simplex, into layouts_
};

}  // namespace cortex::comms
