// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/bench.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cortex::cli::conform {

enum class Needs : std::uint8_t { Nothing, Motion, Homing, Grip };
enum class Per : std::uint8_t { Device, Axis };

// One row of the table of tests. `run` gets the place of the axis in Plant::axes, or 0.
struct Test {
    std::string name;
    std::vector<std::string> types;  // of devices; any of them
    Needs needs = Needs::Nothing;
    Per per = Per::Device;
    std::function<Judgement(Bench&, std::size_t)> run;
};
using Tests = std::vector<Test>;

Tests deviceTests();
Tests fieldbusTests();
Tests axisTests();
Tests ds402Tests();
Tests gripperTests();
// What was seen meanwhile, so they come last.
Tests honestyTests();

}  // namespace cortex::cli::conform
