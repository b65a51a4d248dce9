// SPDX-License-Identifier: Apache-2.0
// Two agents and a tool while somebody on their network sends them what no participant would.
#include "cortex/comms/security.hpp"

#include "comms/datagrams.hpp"
#include "core/model_folder.hpp"
#include "network/attacker.hpp"
#include "network/hand_and_robot.hpp"
#include "network/host.hpp"
#include "processes/agent_process.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <thread>

#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

using Bytes = comms::datagrams::Datagram;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool isInstrumented = true;
#elif defined(__has_feature)
constexpr bool isInstrumented = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool isInstrumented = false;
#endif

// Sanitizers make everything several times as slow, a handshake of security above all.
constexpr auto longestBreak = isInstrumented ? 8000ms : 1500ms;

// What the threads of a process have computed, in s.
double computedBy(pid_t pid) {
    double ticks = 0;
    std::ifstream file{"/proc/" + std::to_string(pid) + "/stat"};
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    std::istringstream rest{text.substr(text.rfind(')') + 1)};
    std::string word;
    for (int i = 3; i <= 15 && rest >> word; ++i) {
        if (i >= 14) ticks += std::stod(word);
    }
    return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

struct AttackedPlant : testing::Test {
    void SetUp() override {
        if (const std::string why = whyNoHosts(); !why.empty()) GTEST_SKIP() << why;
        hosts.emplace();
    }
    void begin(bool secured) {
        std::cout << "seed " << seed << '\n';
        if (secured) {
            comms::createAuthority(folder.path() / "authority");
            for (const char* agent : {"hand", "robot", "station"}) {
                comms::createAgent(folder.path() / "authority", folder.path() / agent,
                                   {agent, {"/"}, {}, {}});
            }
        }
        const auto of = [&](const char* agent) {
            return secured ? (folder.path() / agent).string() : "";
        };
        hosts->first.within([&] { hand.emplace(network("", of("hand"))); });
        hosts->second.within([&] { robot.emplace("", of("robot")); });
        hosts->first.within([&] { station.emplace(network("", of("station"))); });
        attacker.emplace(hosts->first, seed);
        ASSERT_TRUE(isWhole(15s)) << "before the attack";
        attacker->listen(1000);
        ASSERT_GT(attacker->heard(), 200U);
        memory = heldBy(robot->pid()).memory;
        worst = {};
    }

    // Whether the robot has newer data of the hand, and the station newer ones of the robot.
    bool isWhole(std::chrono::milliseconds limit) {
        const std::int64_t cycle = station->cycleOfRobot(), written = lastWritten;
        bool linked = false, seen = false;
        const auto begin = Clock::now();
        while (!(linked && seen) && Clock::now() - begin < limit) {
            linked = linked || robot->newest() > written;
            seen = seen || station->sees(cycle);
            std::this_thread::sleep_for(1ms);
        }
        worst = std::max(worst, Clock::now() - begin);
        lastWritten = std::max(lastWritten, robot->newest());
        return linked && seen;
    }
    testing::AssertionResult isWholeAfter(const std::string& what) {
        if (isWhole(longestBreak)) return testing::AssertionSuccess();
        const bool later = isWhole(10s);
        return testing::AssertionFailure() << "not whole " << longestBreak.count() << " ms after "
                                           << what << (later ? ", but later" : ", and not later");
    }
    bool isTold(const std::string& words) const {
        for (const auto end = Clock::now() + 5s; Clock::now() < end;) {
            for (const std::string& each : station->warnings()) {
                if (each.find(words) != std::string::npos) return true;
            }
            std::this_thread::sleep_for(10ms);
        }
        return false;
    }

    // Sends so many in all; the plant is looked at now and then.
    void attack(int datagrams) {
        constexpr int each = 5'000;
        for (int sent = 0; sent < datagrams; sent += each) {
            attacker->listen(100);
            for (int i = 0; i < each; ++i) {
                attacker->send(attacker->mutated());
                if (i % 50 == 49) std::this_thread::sleep_for(2ms);
            }
            ASSERT_TRUE(isWholeAfter(std::to_string(sent + each) + " datagrams"));
        }
    }

    void checkThatNothingIsLeft(long mostMemory = 1024) {
        // What was done in the name of participants that do not exist ends with their leases.
        const double before = computedBy(robot->pid());
        std::this_thread::sleep_for(1s);
        const double busy = computedBy(robot->pid()) - before;
        EXPECT_LT(busy, 0.6) << "s computed in one";
        const long grown = heldBy(robot->pid()).memory - memory;
        if (!isInstrumented) {  // a sanitizer keeps what was freed
            EXPECT_LE(grown, mostMemory) << "kB more than before";
        }
        std::cout << "longest break "
                  << std::chrono::duration_cast<std::chrono::milliseconds>(worst).count()
                  << " ms, the robot holds " << grown << " kB more and computes " << busy
                  << " s in one second\n";
    }

    const std::uint64_t seed = [] {
        const char* given = std::getenv("CORTEX_SEED");
        return given ? std::stoull(given) : 1;  // the same at each run, unless another is given
    }();
    ModelFolder folder;
    std::optional<TwoHosts> hosts;
    std::optional<HandAgent> hand;
    std::optional<RobotProcess> robot;
    std::optional<Station> station;
    std::optional<Attacker> attacker;
    std::int64_t lastWritten = 0;
    long memory = 0;  // kB, of the robot before
    Clock::duration worst{};
};

// What is known to end, stop or mute participants of Fast DDS 2.9.1 without the filter, in the name
// of each participant and of the writers that agents have.
TEST_F(AttackedPlant, GoesOnAfterEachKnownAttack) {
    ASSERT_NO_FATAL_FAILURE(begin(false));
    using namespace comms::datagrams;
    constexpr std::int64_t far = 1LL << 40;
    const std::vector<std::uint32_t> writers = attacker->writers();
    ASSERT_GT(writers.size(), 5U);
    const auto inEachName = [&](const auto& submessageOf) {
        for (const auto& prefix : attacker->prefixes()) {
            for (const std::uint32_t writer : writers) {
                Bytes datagram = header() + submessageOf(writer);
                std::ranges::copy(prefix, datagram.begin() + 8);
                attacker->sendToAll(datagram);
            }
        }
    };
    const Bytes statistics = submessage(0x80, 0, Bytes(56));
    attacker->sendToAll(header() + statistics + submessage(0x01, 0, {}));
    EXPECT_TRUE(isWholeAfter("statistics inside of a datagram"));
    inEachName([&](std::uint32_t writer) { return data(far, writer); });
    EXPECT_TRUE(isWholeAfter("a sample with the number 2^40"));
    inEachName([&](std::uint32_t writer) { return gap(1, far, 0, 0, writer); });
    EXPECT_TRUE(isWholeAfter("a gap up to 2^40"));
    inEachName([&](std::uint32_t writer) { return heartbeat(far, far, 0x7ffffff0, writer); });
    EXPECT_TRUE(isWholeAfter("a heartbeat from 2^40"));
    inEachName([&](std::uint32_t writer) { return ackNack(far, 0, 0, writer); });
    EXPECT_TRUE(isWholeAfter("an acknowledgement up to 2^40"));
    inEachName([&](std::uint32_t writer) {
        return dataFragment({.sample = 0x7fffffff, .writer = writer});
    });
    EXPECT_TRUE(isWholeAfter("a fragment of a sample of 2 GB"));
    Bytes properties{0, 0, 0, 16};
    properties.resize(900);
    attacker->sendToAll(header() + announcement(parameter(0x59, properties) + endOfList));
    EXPECT_TRUE(isWholeAfter("an announcement of 2^28 properties"));
    checkThatNothingIsLeft();
    EXPECT_TRUE(isTold("dropped: "));

    const auto asked = Clock::now();
    robot->end();
    EXPECT_LT(Clock::now() - asked, 2s) << "after SIGTERM";
}

// A late joiner gets the models, so their writers are heard while it joins.
TEST_F(AttackedPlant, HoldsItsMemoryWhileSamplesBeginThatNeverEnd) {
    ASSERT_NO_FATAL_FAILURE(begin(false));
    using namespace comms::datagrams;
    std::optional<Station> late;
    std::thread hears{[&] { attacker->listen(4000); }};
    hosts->first.within([&] { late.emplace(network("")); });
    hears.join();
    const auto writers = attacker->newest();
    ASSERT_GT(writers.size(), 5U);
    memory = heldBy(robot->pid()).memory;
    for (const auto& [writer, newest] : writers) {
        if ((writer.second & 0xc0) != 0) continue;  // of discovery: never in fragments
        for (int i = 1; i <= 100; ++i) {
            Bytes datagram = header() + dataFragment({.number = newest + i,
                                                      .size = 1'000,
                                                      .sample = 16'000'000,
                                                      .rest = Bytes(1'000),
                                                      .writer = writer.second});
            std::ranges::copy(writer.first, datagram.begin() + 8);
            attacker->sendToAll(datagram);
            std::this_thread::sleep_for(1ms);
        }
    }
    EXPECT_TRUE(isWholeAfter("the first fragments of many samples"));
    checkThatNothingIsLeft();
    EXPECT_TRUE(isTold("began more samples in fragments"));
}

TEST_F(AttackedPlant, HoldsItsMemoryWhileAStrangerAnnouncesEndpoints) {
    ASSERT_NO_FATAL_FAILURE(begin(false));
    using namespace comms::datagrams;
    const Bytes stranger(12, 0x5a);
    Bytes announced;
    for (int i = 0; i < 20 && announced.empty(); ++i) {
        attacker->listen(500);
        announced = attacker->announcementOf(stranger);
    }
    ASSERT_FALSE(announced.empty());
    attacker->sendToAll(announced);
    std::this_thread::sleep_for(100ms);
    for (std::uint32_t i = 0; i < 20'000;) {
        Bytes datagram = header();
        std::ranges::copy(stranger, datagram.begin() + 8);
        for (int each = 0; each < 50; ++each) {
            Bytes guid = stranger;
            putEntity(guid, ++i << 8 | 3);
            datagram = datagram + data(i, 0x000003c2, 4,
                                       Bytes{0, 3, 0, 0} + parameter(0x5a, guid) +
                                           parameter(0x05, text("cortex/" + std::to_string(i))) +
                                           parameter(0x07, text("stranger")) + endOfList);
        }
        attacker->sendToAll(datagram);
        std::this_thread::sleep_for(2ms);
    }
    EXPECT_TRUE(isWholeAfter("20,000 endpoints"));
    checkThatNothingIsLeft(2048);
    EXPECT_TRUE(isTold("announce more endpoints"));
}

TEST_F(AttackedPlant, GoesOnAfterSignedMessagesWithLengthsThatLie) {
    ASSERT_NO_FATAL_FAILURE(begin(true));
    using namespace comms::datagrams;
    Bytes attack = attacker->signedMessage();
    ASSERT_GT(attack.size(), 44U);
    attack.resize(44);  // the header and the prefix
    for (int i = 0; i < 400; ++i) attack = attack + Bytes{1, 1, 255, 255};
    attacker->sendToAll(attack + submessage(0x34, 0, Bytes(20)));
    EXPECT_TRUE(isWholeAfter("a signed message whose lengths lie"));
    EXPECT_TRUE(isTold("dropped: "));
}

int datagrams() {
    const char* given = std::getenv("CORTEX_DATAGRAMS");
    return given ? std::stoi(given) : 100'000;
}

TEST_F(AttackedPlant, GoesOnUnderMutatedTraffic) {
    ASSERT_NO_FATAL_FAILURE(begin(false));
    ASSERT_NO_FATAL_FAILURE(attack(datagrams()));
    checkThatNothingIsLeft();
    EXPECT_TRUE(isTold("dropped: "));
}

TEST_F(AttackedPlant, GoesOnUnderMutatedTrafficWithSecurity) {
    ASSERT_NO_FATAL_FAILURE(begin(true));
    ASSERT_NO_FATAL_FAILURE(attack(datagrams()));
    checkThatNothingIsLeft();
    EXPECT_TRUE(isTold("dropped: "));
}

}  // namespace
}  // namespace cortex::test
