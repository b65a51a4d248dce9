// SPDX-License-Identifier: Apache-2.0
// The program cortex-ds402-sim, by its socket.
#include "cli/cortex_process.hpp"
#include "drive/ds402_registers.hpp"
#include "modbus/sim_process.hpp"
#include "support/waiting.hpp"

#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using cortex::test::comesTrue;
using cortex::test::runProgram;

const std::string program = CORTEX_BINARY_DIR "/bin/cortex-ds402-sim";

class Ds402Sim : public testing::Test {
protected:
    Words seen() { return client.read(Ds402Map::read, Ds402Map::readCount); }
    std::uint16_t status() { return seen()[0]; }
    std::uint16_t transition() { return seen()[0xF] & 0xFF; }
    std::uint16_t transitions() { return seen()[0x11]; }
    std::uint16_t refused() { return seen()[0xF] >> 8; }
    testing::AssertionResult reaches(std::uint16_t state, std::uint16_t word, BareClient& by) {
        return comesTrue("state " + std::to_string(state),
                         [&] { return (by.exchange({word})[0] & 0x6F) == state; });
    }
    void boot() { EXPECT_TRUE(reaches(0x40, 0, client)); }
    void enable() {
        boot();
        EXPECT_EQ(client.write(Ds402Map::watchdog, {0}), 0);
        EXPECT_TRUE(reaches(0x21, 6, client));
        EXPECT_TRUE(reaches(0x23, 7, client));
        EXPECT_TRUE(reaches(0x27, 15, client));
    }

    SimProcess sim;
    BareClient client{sim.port()};
};

TEST_F(Ds402Sim, EndsInOrder) {
    EXPECT_EQ(sim.endInOrder(SIGTERM), 0);
    EXPECT_TRUE(client.isClosed());
    SimProcess other;
    EXPECT_EQ(other.endInOrder(SIGINT), 0);
}

TEST_F(Ds402Sim, SaysInWordsWhyItDoesNotStart) {
    const auto second = runProgram(program, {"--port", std::to_string(sim.port())});
    EXPECT_EQ(second.exit, 1);
    EXPECT_NE(second.errors.find("cannot listen on 127.0.0.1:" + std::to_string(sim.port()) +
                                 ": Address already in use; another program listens there: give "
                                 "another --port"),
              std::string::npos)
        << second.errors;
    const auto nowhere = runProgram(program, {"--address", "nowhere"});
    EXPECT_EQ(nowhere.exit, 1);
    EXPECT_NE(nowhere.errors.find("'nowhere' is no address; write one in numbers"),
              std::string::npos)
        << nowhere.errors;
    for (const auto& wrong : {Words{}, Words{3}}) {
        const auto axes =
            runProgram(program, {"--axes", wrong.empty() ? "many" : std::to_string(wrong.front())});
        EXPECT_EQ(axes.exit, 2);
        EXPECT_NE(axes.errors.find("--axes"), std::string::npos) << axes.errors;
    }
    EXPECT_EQ(runProgram(program, {"--port", "65536"}).exit, 2);
    const auto misspelt = runProgram(program, {"--axis", "2"});
    EXPECT_EQ(misspelt.exit, 2);
    EXPECT_NE(misspelt.errors.find("there is no option '--axis'; nearest of: --axes"),
              std::string::npos)
        << misspelt.errors;
    EXPECT_EQ(runProgram(program, {"--travel", "inf"}).exit, 2);
    EXPECT_EQ(runProgram(program, {"--help"}).exit, 0);
    EXPECT_NE(runProgram(program, {"--version"}).output.find("cortex-ds402-sim 0."),
              std::string::npos);
}

TEST_F(Ds402Sim, MakesAll17TransitionsBeforeAClientOfAnotherMaker) {
    const auto outcome =
        runProgram("/usr/bin/python3",
                   {CORTEX_SOURCE_DIR "/tests/modbus/transitions.py", std::to_string(sim.port())});
    if (outcome.exit == 77) GTEST_SKIP() << "python3-pymodbus is not installed";
    EXPECT_EQ(outcome.exit, 0) << outcome.output << outcome.errors;
    EXPECT_NE(outcome.output.find("[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]"),
              std::string::npos)
        << outcome.output;
}

// Each is a change of the word that the state does not know: 30 of them.
TEST_F(Ds402Sim, CountsWrongWordsAndDoesNothing) {
    int wrong = 0;
    const auto say = [&](const Words& words) {
        const Words before = seen();
        for (const std::uint16_t word : words) {
            const std::uint16_t counted = refused();
            client.exchange({word});
            EXPECT_TRUE(comesTrue("a refused word", [&] {
                return refused() == static_cast<std::uint8_t>(counted + 1);
            })) << word;
            ++wrong;
        }
        const Words after = seen();
        EXPECT_EQ(after[0], before[0]) << "status word";
        EXPECT_EQ(after[0x11], before[0x11]) << "transitions";
        EXPECT_EQ(Words(&after[2], &after[4]), Words(&before[2], &before[4])) << "position";
    };
    boot();
    EXPECT_EQ(client.write(Ds402Map::watchdog, {0}), 0);
    say({0x07, 0x0F, 0x07, 0x8F, 0x0F, 0x87, 0x86, 0x07, 0x0F, 0x8B});
    EXPECT_TRUE(reaches(0x21, 6, client));
    say({0x86, 0x8F, 0x82, 0x80});
    client.exchange({6});
    say({0x8E, 0x87});
    EXPECT_TRUE(reaches(0x23, 7, client));
    say({0x87, 0x8F, 0x86, 0x82});
    client.exchange({7});
    say({0x83, 0x81});
    EXPECT_TRUE(reaches(0x27, 15, client));
    say({0x8F, 0x87, 0x86, 0x82});
    client.exchange({15});
    say({0x80, 0x88, 0x8A, 0x8B});
    EXPECT_EQ(wrong, 30);
}

TEST_F(Ds402Sim, LetsOneCommandAndOthersRead) {
    enable();
    BareClient other{sim.port()};
    EXPECT_EQ(other.read(0x0100, 1)[0] & 0x6F, 0x27);
    EXPECT_EQ(other.write(0x0000, {0}), 4);
    EXPECT_EQ(other.write(0x1000, {0, 1}), 4);
    EXPECT_THROW(other.exchange({0}), std::runtime_error);
    EXPECT_EQ(client.exchange({15})[0] & 0x6F, 0x27) << "nothing has happened";
    EXPECT_EQ(other.write(0xF002, {0, 0}), 0) << "but faults may be commanded by anybody";

    client.hangUp();
    EXPECT_TRUE(client.isClosed());
    EXPECT_TRUE(comesTrue("a fault of the drive that nobody commands",
                          [&] { return (other.read(0x0100, 1)[0] & 0x4F) == 0x08; }));
    EXPECT_EQ(other.read(0x0107, 1)[0], 0x7500);
    EXPECT_EQ(other.write(0x0000, {0x80}), 0) << "the place is free";
}

TEST_F(Ds402Sim, StopsWhenNoExchangeComesInTime) {
    enable();
    EXPECT_EQ(client.write(Ds402Map::watchdog, {10}), 0);
    EXPECT_TRUE(comesTrue("a trip", [&] { return client.read(0x2001, 1)[0] == 1; }));
    EXPECT_TRUE(comesTrue("Fault", [&] { return (status() & 0x4F) == 0x08; }));
}

TEST(PausedDs402Sim, StopsAfterAPauseOfItsProcessAndDoesNotLeap) {
    SimProcess sim{{"--longest-pause", "50"}};
    BareClient client{sim.port()};
    const auto state = [&](std::uint16_t word) { return client.exchange({word})[0] & 0x6F; };
    EXPECT_TRUE(comesTrue("an enabled drive", [&] {
        EXPECT_EQ(client.write(Ds402Map::watchdog, {0}), 0);
        for (const auto& [word, wanted] :
             {std::pair{0x80, 0x40}, {0, 0x40}, {6, 0x21}, {7, 0x23}, {15, 0x27}}) {
            for (int i = 0; i < 100 && state(static_cast<std::uint16_t>(word)) != wanted; ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        return state(15) == 0x27;
    }));
    sim.signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds{150});
    sim.signal(SIGCONT);
    EXPECT_TRUE(comesTrue("Fault", [&] { return (state(15) & 0x4F) == 0x08; }));
    EXPECT_EQ(client.read(0x0107, 1)[0], 0x7500);
}

TEST_F(Ds402Sim, HangsUpOnWhatIsNoModbusAndStaysThereForOthers) {
    const Octets wrong[] = {
        {'G', 'E', 'T', ' ', '/', '\r', '\n', '\r', '\n'},
        {0, 1, 0, 1, 0, 2, 1, 3},
        {0, 1, 0, 0, 0, 0, 1, 3},
        {0, 1, 0, 0, 0xFF, 0xFF, 1, 3},
        {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF},
    };
    for (const Octets& octets : wrong) {
        BareClient hostile{sim.port()};
        hostile.send(octets);
        EXPECT_TRUE(hostile.isClosed());
    }
    BareClient half{sim.port()};
    half.send(Octets{0, 1, 0, 0, 0, 6, 1, 3, 1});
    half.hangUp();
    EXPECT_TRUE(half.isClosed());
    EXPECT_EQ(client.read(0x3000, 1)[0], 0x4358);
}

TEST_F(Ds402Sim, StandsAnyOctets) {
    std::mt19937 random{402};
    for (int i = 0; i < 60; ++i) {
        BareClient hostile{sim.port()};
        Octets octets(1 + random() % 300);
        for (std::uint8_t& each : octets) each = static_cast<std::uint8_t>(random());
        if (i % 2 == 0) {  // behind a good header
            octets.resize(std::max<std::size_t>(octets.size(), 8));
            const auto length = static_cast<std::uint16_t>(2 + random() % 252);
            octets[2] = octets[3] = 0;
            octets[4] = static_cast<std::uint8_t>(length >> 8);
            octets[5] = static_cast<std::uint8_t>(length);
        }
        hostile.send(octets);
        hostile.hangUp();
        EXPECT_TRUE(hostile.isClosed());
    }
    EXPECT_FALSE(sim.hasEnded());
    EXPECT_EQ(client.read(0x3000, 1)[0], 0x4358);
}

TEST_F(Ds402Sim, AnswersRequestsThatComeTogetherOneAfterTheOther) {
    Octets many;
    for (std::uint8_t i = 0; i < 100; ++i)
        many.insert(many.end(), {0, i, 0, 0, 0, 6, 1, 3, 0x30, 0, 0, 1});
    client.send(many);
    for (std::uint8_t i = 0; i < 100; ++i)
        EXPECT_EQ(client.receive(11), (Octets{0, i, 0, 0, 0, 5, 1, 3, 2, 0x43, 0x58}));
}

TEST_F(Ds402Sim, RefusesConnectionsOnCommandUntilNobodyIsThere) {
    boot();
    {
        BareClient tool{sim.port()};
        EXPECT_EQ(tool.write(0xF104, {1}), 0);
        EXPECT_TRUE(client.isClosed()) << "it commanded";
        EXPECT_THROW(BareClient{sim.port()}, std::runtime_error);
        EXPECT_EQ(tool.read(0xF104, 1)[0], 1);
    }
    EXPECT_TRUE(comesTrue("a connection", [&] {
        try {
            return BareClient{sim.port()}.read(0x3000, 1)[0] == 0x4358;
        } catch (const std::runtime_error&) {
            return false;
        }
    }));
}

TEST_F(Ds402Sim, FreezesOnCommandForAllButWhoMayThawIt) {
    boot();
    BareClient tool{sim.port()};
    EXPECT_EQ(tool.write(0xF105, {1}), 0);
    client.send(Octets{0, 1, 0, 0, 0, 6, 1, 3, 1, 0, 0, 1});
    EXPECT_EQ(tool.read(0xF105, 1)[0], 1);
    EXPECT_EQ(tool.write(0xF105, {0}), 0);
    client.send(Octets{0, 2, 0, 0, 0, 6, 1, 3, 0x30, 0, 0, 1});
    EXPECT_EQ(client.receive(11), (Octets{0, 2, 0, 0, 0, 5, 1, 3, 2, 0x43, 0x58}))
        << "the request before got no answer";
}

TEST(LoggingDs402Sim, PrintsTransitions) {
    SimProcess sim{{"--log", "--axes", "2"}};
    EXPECT_TRUE(sim.prints("axis 2: transition 1, Not ready to switch on -> Switch on disabled"));
}

}  // namespace
}  // namespace cortex::modbus::test
