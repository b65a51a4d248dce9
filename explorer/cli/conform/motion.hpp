// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/bench.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cortex::cli::conform {

// What one axis did while it was moved: to and fro, until its controller was shut down on the way,
// and with its brake on. All positions are in the unit of the axis.
struct Trial {
    struct Point {
        double seconds = 0, demanded = 0, observed = 0, speed = 0, acceleration = 0;
    };
    struct Leg {
        double from = 0, to = 0, reached = 0;
        std::string answer;    // to the command that moved it; "": done
        bool arrived = false;  // near enough, 2 s after the answer at the latest
    };
    struct Loss {  // of the demand, on the way
        double begin = 0, at = 0, target = 0, rest = 0, seconds = 0;
        bool came = false;  // to rest
    };
    struct Brake {
        std::string status;  // that its observation shows
        bool isOn = false;
        double drift = 0;
    };

    std::string unit, controller;
    double amplitude = 0, near = 0;  // near: a twentieth of the amplitude
    std::optional<double> startGap;  // of demand and observation as the device became Active
    std::vector<Leg> legs;
    std::vector<Point> points;  // of all legs
    std::optional<Loss> loss;
    std::optional<Brake> brake;
    std::optional<Judgement> ended;  // why it ended early
};

// Moves the axis; only once, however often it is asked for.
const Trial& trialOf(Bench& bench, const AxisPair& axis);

// Greatest position, speed that the type of a demand allows; infinite where it says nothing.
struct AxisBounds {
    double least, most, speed;
};
AxisBounds boundsOf(const Type& demand);

}  // namespace cortex::cli::conform
