// SPDX-License-Identifier: Apache-2.0
// `cortex watch --rate 0` beside an agent whose cycles come faster than it can send them.
#include "cli/live_agent.hpp"
#include "cli/stepped_agent.hpp"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// Each burst begins when the last cycle of the one before is printed.
TEST(CortexCycles, WatchPrintsEachToWhoAsksForEveryCycle) {
    SteppedRobot robot{std::stoi(domain)};
    std::string command = "exec timeout " + patient +
                          " " CORTEX_BINARY_DIR
                          "/bin/cortex watch /signal.count --csv --rate 0 --count 300";
    for (const std::string& each : network) command += " " + each;
    FILE* output = popen(command.c_str(), "re");
    ASSERT_NE(output, nullptr);

    std::vector<std::int64_t> cycles;
    std::array<char, 4096> line{};
    while (std::fgets(line.data(), line.size(), output) != nullptr) {
        const std::string text = line.data();
        const std::string value = text.substr(text.find(',') + 1);
        if (value.front() >= '0' && value.front() <= '9') cycles.push_back(std::stoll(value));
        if (cycles.empty() || cycles.back() == robot.cycle()) robot.step(30);
    }
    pclose(output);

    ASSERT_EQ(cycles.size(), 300U);
    for (std::size_t i = 1; i < cycles.size(); ++i) {
        ASSERT_LE(cycles[i], cycles[i - 1] + 1) << "a cycle is missing";
    }
    EXPECT_GT(cycles.back(), cycles.front() + 100);
}

}  // namespace
}  // namespace cortex::test
