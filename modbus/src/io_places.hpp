// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/data.hpp"
#include "cortex/core/simplex.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cortex::modbus {

// One number or signal of a coupler: of a group, or a concept of its own.
template <class T>
struct IoPlace {
    InputSimplex simplex;  // the group, or the concept
    bool isInGroup;
    std::size_t number;  // in its group, from 0
    Data<T> value;
    bool hasWriter = true;  // of an output: somebody else speaks for it
};

// The two rules by which the places of one kind are related.
struct IoRules {
    std::string device;  // its path
    std::string_view group, singles;
};
[[noreturn]] void refuseBoth(const IoRules& rules);

// What is wrong with a concept, as Error: "/fans (Fans) has …".
[[noreturn]] void refuse(const InputSimplex& simplex, const std::string& why);

std::size_t countOf(const InputSimplex& group);  // throws Error for one of another agent

// In populate(): the places of the group, or the single concepts in order. Throws Error where both
// are related.
template <class T, class Related>
std::vector<IoPlace<T>> ioPlaces(const RelatedList<Related>& groups,
                                 const RelatedList<Related>& singles, const IoRules& rules) {
    using Plain = std::remove_const_t<T>;
    if (!groups.empty() && !singles.empty()) refuseBoth(rules);
    std::vector<IoPlace<T>> places;
    for (const Related& group : groups) {
        const InputSimplex simplex{group};
        const auto values = group.template array<Plain>("value");
        const std::size_t count = countOf(simplex);
        for (std::size_t i = 0; i < count; ++i)
            places.push_back({simplex, true, i, Data<T>{&values[i]}});
    }
    for (const Related& single : singles) {
        places.push_back({InputSimplex{single}, false, 0, single.template data<Plain>("value")});
    }
    return places;
}

// What its type or its system says of a place, in populate().
template <class T>
std::string atPlace(const IoPlace<T>& place) {
    return place.isInGroup ? " at place " + std::to_string(place.number) + " (from 0)" : "";
}

struct Scale {
    double scale, offset;
};
Scale scaleOf(const IoPlace<const double>& place);  // throws Error for 0, and for another agent's
Scale scaleOf(const IoPlace<double>& place);
// The value that its type gives as safe. Throws Error where there is none.
double safeValueOf(const IoPlace<const double>& place);
bool safeValueOf(const IoPlace<const bool>& place);

}  // namespace cortex::modbus
