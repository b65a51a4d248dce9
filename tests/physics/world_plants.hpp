// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/model_files.hpp"
#include "cortex/cs/testing.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::physics::test {

using Pairs = cs::TestPlant::Pairs;
using Entries = std::vector<SystemDescription::SimplexEntry>;

// As in a system file: rule and path of each relation, item and text of each setting.
SystemDescription::SimplexEntry entry(const std::string& path, const std::string& type,
                                      const Pairs& relates = {}, const Pairs& settings = {});
Entries operator+(Entries one, const Entries& other);
// The entry of this path, to add to it or to change it.
SystemDescription::SimplexEntry& at(Entries& entries, std::string_view path);

// An LBR as /lbr in /world, and its controllers /hold and /pose.
constexpr std::array lbrStart{0.0, 0.6, 0.0, -1.4, 0.0, 1.1, 0.0};
Entries lbrPlant(const Pairs& world = {});
// A table whose top is at 0.4 m, and a box of 60 mm and 0.3 kg on it: /table, /box, /boxPose.
// `above`: the box is so far above the table.
Entries tableAndBox(double above = 0);
// The same in /world with a carriage /lift, which carries a 2F-85 as /gripper above the box. Their
// controllers: /lifter and /grip.
Entries liftPlant(double above = 0);
// The same, with demands that nobody writes but the test.
Entries withoutControllers(Entries entries);

// Types that the plants need.
std::vector<std::filesystem::path> worldModel();

}  // namespace cortex::physics::test
