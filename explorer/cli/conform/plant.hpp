// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/live.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::cli::conform {

// What a controller demands of one axis, and what is observed of it.
struct AxisPair {
    std::uint32_t demand = noSimplex, observation = noSimplex;
    std::size_t place = 0;  // among the axes of its device or processor, from 0
};

// A controller that can bring an axis to a position on command.
struct Mover {
    enum Kind : std::uint8_t { Poses, Jogs, Grips };

    std::uint32_t controller = noSimplex;
    std::size_t place = 0;  // of the axis among those of the controller, from 0
    Kind kind = Poses;
};

// A device and what it is joined to in its agent. Simplexes are numbers in its structure.
struct Plant {
    std::string agent;
    std::shared_ptr<const Structure> structure;
    std::uint32_t device = noSimplex, cluster = noSimplex;
    std::vector<std::uint32_t> demands, observations;  // of the device
    std::optional<std::uint32_t> processor;            // whose drives are its observations
    std::vector<AxisPair> axes;

    const SimplexInfo& info(std::uint32_t simplex) const { return structure->simplexes[simplex]; }
    const std::string& path(std::uint32_t simplex) const { return info(simplex).path; }
    const Type& type(std::uint32_t simplex) const { return *info(simplex).layout->type; }
    const Type& deviceType() const { return type(device); }
    bool deviceIs(std::string_view type) const { return deviceType().isA(type); }
    bool hasAxes() const;                    // or should have some
    bool isGripper() const;                  // a GripperController moves it
    std::vector<std::uint32_t> all() const;  // the device, its demands and observations
    // What is related by the rule, or by one that refines it, in order.
    std::vector<std::uint32_t> related(std::uint32_t owner, std::string_view rule) const;
    // Who writes the demand and can be commanded to a position.
    std::vector<Mover> movers(const AxisPair& axis) const;
    // All of which a test may want the values.
    std::vector<std::uint32_t> followed() const;
};

// Throws Failure where there is no such simplex, or where it is no device.
Plant findPlant(Live& live, const std::string& path);

}  // namespace cortex::cli::conform
