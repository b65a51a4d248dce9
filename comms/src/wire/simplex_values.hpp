// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/tables.hpp"

#include "wire/messages.hpp"

#include <cstdint>
#include <string>
#include <vector>

// The cyclic values of one simplex in tables and on the wire: by kind, then in the order of its
// layout.
namespace cortex::comms {

// Uses the memory that `to` has.
void readValues(std::uint32_t simplex, const TypeLayout& layout, const Slice& from,
                SimplexData& to);

// In which way the data cannot be of a simplex with this layout: "3 floats instead of 2". "": it
// can. How old it is does not matter.
std::string misfit(const SimplexData& data, const TypeLayout& layout);
// Stores the values. The strings of the slice have their capacities (SliceMemory).
void storeValues(const SimplexData& data, const TypeLayout& layout, const Slice& to);

// A slice outside the tables, with each item's default value: the cyclic items or the constant
// ones.
class SliceMemory {
public:
    explicit SliceMemory(const TypeLayout& layout, bool constants = false);
    SliceMemory(const SliceMemory&) = delete;
    SliceMemory& operator=(const SliceMemory&) = delete;

    const Slice& slice() const { return slice_; }
    void copy(const SliceMemory& other);  // of the same layout

private:
    std::vector<std::uint64_t> memory_;
    SlotState state_;
    Slice slice_;
};

}  // namespace cortex::comms
