// SPDX-License-Identifier: Apache-2.0
// No true writer is dropped for ever, whatever its rate, loss or pause, and what is forged beside
// it is. Time is simulated. CORTEX_WRITERS: how many writers, the first of which are always the
// same.
#include "rtps/writer_numbers.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms::rtps {
namespace {

constexpr std::int64_t ms = 1'000'000, second = 1'000 * ms, hour = 3'600 * second;
constexpr std::int64_t mostTime = 50 * ms;  // without a number that passes
constexpr int mostArrivals = 32;

struct Arrival {
    std::int64_t time, number;
    std::uint32_t saying;
};

// A writer, of whose numbers some are lost and some late.
struct Network {
    explicit Network(unsigned seed) : chance{seed} {
        constexpr std::array<std::int64_t, 8> rates{1,      10,      100,     1'000,
                                                    20'000, 100'000, 160'000, 200'000};
        constexpr std::array losses{0, 20, 50, 80, 95};
        constexpr std::array<std::int64_t, 4> delays{0, ms / 10, 2 * ms, 20 * ms};
        rate = rates[chance() % rates.size()];
        lost = losses[chance() % losses.size()];
        late = delays[chance() % delays.size()];
        burst = chance() % 3 == 0 ? 20 : 1;  // so many are lost together
        states = chance() % 2 == 0;
    }

    std::string text() const {
        return std::to_string(rate) + " a second, " + std::to_string(lost) + " % lost, up to " +
               std::to_string(late / ms) + " ms late, in bursts of " + std::to_string(burst);
    }

    // What arrives of so many numbers, sent one after another.
    std::vector<Arrival> sends(std::int64_t count) {
        std::vector<Arrival> all;
        bool isLost = false;
        for (std::int64_t i = 0; i < count; ++i) {
            now += second / rate;
            ++number;
            if (i % burst == 0) isLost = static_cast<int>(chance() % 100) < lost;
            if (isLost) continue;
            const std::int64_t delay =
                late > 0 ? static_cast<std::int64_t>(chance() % static_cast<unsigned>(late)) : 0;
            const bool isHeartbeat = states && chance() % 4 == 0;  // says the same again
            all.push_back({now + delay, isHeartbeat ? number - 1 : number, said++});
        }
        std::ranges::sort(all, {}, &Arrival::time);
        return all;
    }

    // Unheard for a while, in which it sends or not.
    void pauses() {
        constexpr std::array<std::int64_t, 6> lengths{20 * ms,     80 * ms,      second,
                                                      60 * second, 600 * second, hour};
        const std::int64_t length = lengths[chance() % lengths.size()];
        now += length;
        if (chance() % 4 != 0) number += length / (second / rate);
    }

    std::mt19937 chance;
    std::int64_t rate = 0, late = 0, now = 1'000 * second, number = 0;
    int lost = 0, burst = 0;
    bool states = false;
    std::uint32_t said = 0;
};

class WriterNumbersTest : public testing::Test {
protected:
    // Follows what arrives; a number is forged before some.
    void follow(Network& network, std::int64_t numbers, unsigned forgedOf) {
        for (const Arrival& each : network.sends(numbers)) {
            if (highest > 0 && forgedOf > 0 && network.chance() % forgedOf == 0)
                forge(network, each.time);
            highest = std::max(highest, each.number);
            ++arrivals;
            if (since == 0) since = each.time;
            if (judged.admits(writer, each.number, each.saying, each.time)) {
                arrivals = 0;
                since = each.time;
            }
            ASSERT_FALSE(arrivals > mostArrivals && each.time - since > mostTime)
                << each.number << " is dropped, with all " << arrivals << " before it";
        }
    }

    // Now and then, so not twice near each other.
    void forge(Network& network, std::int64_t time) {
        const std::int64_t far = 1LL << (18 + forged++ * 5 % 21);
        const auto some = static_cast<std::int64_t>(network.chance() % 1'000);
        EXPECT_FALSE(judged.admits(writer, highest + far + some, 0, time))
            << far << " above " << highest;
    }

    static unsigned writers() {
        const char* asked = std::getenv("CORTEX_WRITERS");
        return asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : 20;
    }

    WriterGuid writer{1};
    WriterNumbers judged;
    std::int64_t highest = 0, since = 0;
    int arrivals = 0;  // since one passed
    unsigned forged = 0;
};

TEST_F(WriterNumbersTest, AfterEachLossAndPauseAWriterIsAdmittedAgain) {
    for (unsigned seed = 1; seed <= writers() && !HasFailure(); ++seed) {
        Network network{seed};
        SCOPED_TRACE("seed " + std::to_string(seed) + ": " + network.text());
        writer[1] = static_cast<std::uint8_t>(seed);
        writer[2] = static_cast<std::uint8_t>(seed >> 8);
        highest = since = arrivals = 0;
        const unsigned forgedOf = seed % 2 == 0 ? 5 : 0;
        const std::int64_t some = std::max<std::int64_t>(network.rate / 12, 800);
        for (int part = 0; part < 3; ++part) {
            follow(network, some, forgedOf);
            network.pauses();
            arrivals = 0;
            since = 0;
        }
        follow(network, some, forgedOf);
    }
}

// 200,000 a second, which is more than passes at once.
TEST_F(WriterNumbersTest, AfterAPauseAQuickWriterIsAdmittedWithin50Ms) {
    ASSERT_TRUE(judged.admits(writer, 1, 0, second));
    std::int64_t now = second + hour, number = 1 + hour / 5'000, dropped = 0;
    for (; !judged.admits(writer, number, 0, now); ++dropped, ++number, now += 5'000)
        ASSERT_LT(now, second + hour + mostTime);
    EXPECT_GT(dropped, 1'000) << "at once: anybody could forge it";
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(judged.admits(writer, ++number, 0, now += 5'000));
}

// In place of the writer, which is silent.
TEST_F(WriterNumbersTest, AJumpIsBoundedByTheTimeWithoutTheWriterAndByTheRun) {
    const auto lasts = [&](std::int64_t silence, std::int64_t jump) {
        ++writer[1];
        judged.admits(writer, 1, 0, second);
        const std::int64_t begin = second + silence;
        std::int64_t now = begin;
        for (std::int64_t number = 1 + jump; now < begin + 20 * second; now += ms, ++number)
            if (judged.admits(writer, number, 0, now)) return (now - begin) / ms;
        return std::int64_t{-1};
    };
    EXPECT_EQ(lasts(second, 100'000), 1) << "as 100 in a millisecond, it needs one more only";
    EXPECT_EQ(lasts(second, 1'000'000), 30);
    EXPECT_EQ(lasts(hour, 720'000'000), 30);
    EXPECT_EQ(lasts(second, 20LL * second), -1) << "nobody is so quick";
    EXPECT_GE(lasts(hour, 2LL << 30), 10'000) << "what takes long to count, needs long";
}

TEST_F(WriterNumbersTest, ARunEndsWhereItsWriterGoesOn) {
    ASSERT_TRUE(judged.admits(writer, 1, 0, second));
    std::int64_t now = second, forged = 10'000'000;
    for (std::int64_t number = 2; number < 200; ++number) {
        for (int i = 0; i < 7; ++i)
            EXPECT_FALSE(judged.admits(writer, ++forged, 0, now += 10 * ms)) << forged;
        EXPECT_TRUE(judged.admits(writer, number, 0, now += 10 * ms)) << number;
    }
}

// Each in steps that pass, 4 numbers at a time.
void creep(WriterNumbers& numbers, const WriterGuid& writer, std::int64_t& forged,
           std::int64_t now) {
    forged += 4;
    ASSERT_TRUE(numbers.admits(writer, forged, 0, now));
}

TEST(WriterNumbers, TellsThatAWriterIsSkippedWhereSomebodyCreptAheadOfIt) {
    for (const std::int64_t ahead : {40, 40'000}) {  // also where it counts as met anew
        WriterNumbers numbers;
        const WriterGuid writer{1};
        std::int64_t now = second, number = 100, forged = number;
        ASSERT_TRUE(numbers.admits(writer, number, 0, now));
        while (forged < number + ahead) creep(numbers, writer, forged, now += ms);

        const std::int64_t over = now;
        std::int64_t told = 0;
        for (int i = 0; i < 50 && told == 0; ++i) {
            ASSERT_TRUE(numbers.admits(writer, ++number % 2 == 0 ? number : number - 1, 0,
                                       now += 100 * ms));
            if (numbers.areSkipped(writer, now)) told = now;
        }
        EXPECT_GE(told - over, 3 * second) << ahead;
        EXPECT_LE(told - over, 4 * second) << ahead;
        EXPECT_FALSE(numbers.areSkipped(writer, now + 2 * second)) << "it goes on no more";
        EXPECT_FALSE(numbers.areSkipped({2}, now)) << "another one";
    }
}

TEST(WriterNumbers, TellsOfNoTrueWriterThatItIsSkipped) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Network network{seed};
        WriterNumbers numbers;
        const WriterGuid writer{1};
        for (const Arrival& each :
             network.sends(std::min<std::int64_t>(20 * network.rate, 20'000))) {
            numbers.admits(writer, each.number, each.saying, each.time);
            ASSERT_FALSE(numbers.areSkipped(writer, each.time)) << network.text();
        }
    }
}

}  // namespace
}  // namespace cortex::comms::rtps
