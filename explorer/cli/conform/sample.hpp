// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli::conform {

// Where the numbers of each simplex stand in a sample.
struct SampleLayout {
    struct Place {
        std::size_t first = 0, length = 0;
    };
    struct Part {
        std::uint32_t simplex = noSimplex;
        std::vector<const ItemLayout*> items;
        std::map<std::string, Place, std::less<>> places;  // of the elements of each item
    };
    std::vector<Part> parts;
    std::map<std::uint32_t, std::size_t> partOf;

    SampleLayout(const Structure& structure, const std::vector<std::uint32_t>& simplexes);
};

// The numbers of some simplexes after one cycle, copied out of an image.
class Sample {
public:
    Sample() = default;
    Sample(std::shared_ptr<const SampleLayout> layout, const Image& image);

    std::int64_t cycle = 0, time = 0;  // ns since the agent's start, by its own time

    double seconds() const { return static_cast<double>(time) * 1e-9; }
    // None: there is no such item, or it is a text or a constant.
    std::optional<double> number(std::uint32_t simplex, std::string_view item,
                                 std::size_t element = 0) const;
    // The same, or 0.
    double at(std::uint32_t simplex, std::string_view item, std::size_t element = 0) const {
        return number(simplex, item, element).value_or(0);
    }
    std::int64_t count(std::uint32_t simplex, std::string_view item, std::size_t element = 0) const;
    State stateOf(std::uint32_t simplex) const;  // Fault where it says none
    const SlotState& slot(std::uint32_t simplex) const;

private:
    std::shared_ptr<const SampleLayout> layout_;
    std::vector<SlotState> slots_;
    std::vector<double> numbers_;
};

// The elements of a value as numbers; a text has none.
std::vector<double> numbersOf(const Value& value);

}  // namespace cortex::cli::conform
