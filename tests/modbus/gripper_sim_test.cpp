// SPDX-License-Identifier: Apache-2.0
// The program cortex-gripper-sim, by its socket.
#include "cli/cortex_process.hpp"
#include "modbus/sim_process.hpp"
#include "support/waiting.hpp"

#include <csignal>
#include <string>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using cortex::test::comesTrue;
using cortex::test::runProgram;

const std::string gripperProgram = CORTEX_BINARY_DIR "/bin/cortex-gripper-sim";

class GripperSim : public testing::Test {
protected:
    Words status() { return client.read(2000, 3); }
    bool isActivated() { return (status()[0] & 0x3100) == 0x3100; }
    void makeActive() {
        EXPECT_EQ(client.write(1000, {0x0100, 0, 0}), 0);
        EXPECT_TRUE(comesTrue("activated", [&] { return isActivated(); }));
    }

    SimProcess sim{{"--activation-time", "0.03", "--object", "0.04", "--log"},
                   "cortex-gripper-sim"};
    BareClient client{sim.port()};
};

TEST_F(GripperSim, IsActivatedAndGripsByTheOctetsOfTheTable) {
    EXPECT_EQ(status(), (Words{0, 0, 0x0300}));
    makeActive();
    EXPECT_EQ(client.write(1000, {0x0900, 0x00FF, 0xFF80}), 0);
    EXPECT_TRUE(comesTrue("a grip", [&] { return status()[0] == 0xB900; }));
    EXPECT_EQ(status()[1], 0x00FF) << "no fault, and the echo";
    EXPECT_EQ(status()[2] >> 8, 123) << "40 mm";
    EXPECT_GT(status()[2] & 0xFF, 0) << "current";
    EXPECT_EQ(client.read(1000, 3), (Words{0x0900, 0x00FF, 0xFF80}));
    EXPECT_TRUE(sim.prints("gSTA 3, gOBJ 2, gFLT 0, width 40.0 mm"));
}

TEST_F(GripperSim, AnswersFunctionCodes3And4And23AndAPartOfTheRegisters) {
    makeActive();
    const Octets answer{6, 0x31, 0, 0, 0, 3, 0};
    for (const std::uint8_t function : {std::uint8_t{3}, std::uint8_t{4}}) {
        Octets whole{function};
        whole.insert(whole.end(), answer.begin(), answer.end());
        EXPECT_EQ(client.ask({function, 0x07, 0xD0, 0, 3}), whole);
    }
    EXPECT_EQ(client.ask({23, 0x07, 0xD1, 0, 1, 0x03, 0xE9, 0, 1, 2, 0, 0x7B}),
              (Octets{23, 2, 0, 0x7B}));
    EXPECT_EQ(client.read(1000, 2), (Words{0x0100, 0x007B}));
    EXPECT_EQ(client.ask({4, 0x07, 0xD0, 0, 4}), (Octets{0x84, 2})) << "beyond its registers";
    EXPECT_EQ(client.write(1002, {0, 0}), 2);
}

TEST_F(GripperSim, BreaksOnCommandOfAnybody) {
    makeActive();
    BareClient tool{sim.port()};
    EXPECT_EQ(tool.write(1000, {0, 0, 0}), 4) << "another one commands";
    EXPECT_EQ(tool.write(0xF000, {0x10}), 3) << "no code";
    EXPECT_EQ(tool.write(0xF000, {0x0E}), 0);
    EXPECT_EQ(status()[1], 0x0E00);
    EXPECT_EQ(tool.read(0xF000, 4), (Words{0, 400, 0, 0})) << "once; the object is 40 mm wide";
    EXPECT_EQ(tool.write(0xF003, {1}), 0);
    EXPECT_EQ(status(), (Words{0, 0, 0x0300}));
    EXPECT_EQ(tool.write(0xF100, {0, 0, 6, 1}), 0) << "the next answer is exception 4";
    EXPECT_EQ(client.ask({4, 0x07, 0xD0, 0, 1}), (Octets{0x84, 4}));
    EXPECT_EQ(client.ask({4, 0x07, 0xD0, 0, 1}), (Octets{4, 2, 0, 0}));
    EXPECT_EQ(tool.write(0xF104, {7}), 3);
}

TEST(GripperSimProgram, SaysInWordsWhyItDoesNotStart) {
    const auto misspelt = runProgram(gripperProgram, {"--objects", "0.04"});
    EXPECT_EQ(misspelt.exit, 2);
    EXPECT_NE(misspelt.errors.find("there is no option '--objects'; nearest of: --object"),
              std::string::npos)
        << misspelt.errors;
    for (const char* wide : {"1", "nan", "-1", "inf", ""})
        EXPECT_EQ(runProgram(gripperProgram, {"--object", wide}).exit, 2) << wide;
    EXPECT_EQ(runProgram(gripperProgram, {"--address", "nowhere"}).exit, 1);
    EXPECT_EQ(runProgram(gripperProgram, {"--help"}).exit, 0);
    EXPECT_NE(runProgram(gripperProgram, {"--version"}).output.find("cortex-gripper-sim 0."),
              std::string::npos);
}

}  // namespace
}  // namespace cortex::modbus::test
