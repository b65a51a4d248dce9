// SPDX-License-Identifier: Apache-2.0
#include "network/processes.hpp"

#include <gtest/gtest.h>

int main(int count, char** words) {
    const std::string role = count > 2 ? words[1] : "";
    if (role == "robot") {
        cortex::test::runRobot(std::stoi(words[2]), count > 3 ? words[3] : "",
                               count > 4 ? words[4] : "");
        return 0;
    }
    if (role == "station") cortex::test::runStation(words[2]);
    testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
