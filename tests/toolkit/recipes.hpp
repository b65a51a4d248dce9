// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rig.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cortex::toolkit::test {

constexpr std::int64_t runUp = 400;  // cycles

// How one class is made, started and fed. `past` makes one history differ from another; from cycle
// `runUp` on both are fed alike.
struct Recipe {
    std::string type;
    bool keeps;  // it has a state that is no item
    std::function<void(Rig&)> build;
    std::function<void(Rig&, std::int64_t cycle, double past)> feed;
};

// One for each class of the toolkit; a test fails where one is missing.
const std::vector<Recipe>& recipes();

// The longer the past, the later a startup came.
std::int64_t startedIn(double past);

}  // namespace cortex::toolkit::test
