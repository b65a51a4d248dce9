// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/image_parts.hpp"

#include "cortex/core/image.hpp"

#include "support/small_structure.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cortex {
namespace {

using Indices = std::vector<std::uint32_t>;

constexpr std::uint32_t pumpCount = 2000;
constexpr std::uint32_t half = pumpCount / 2;

// Pumps /p1000 to /p2999, each with data of its own, and a signal that one of them writes.
struct Pumps {
    std::shared_ptr<const Structure> structure;
    std::uint32_t signal = pumpCount;
};

Pumps makePumps(bool allKinds = true) {
    test::SmallStructure made;
    std::vector<DataItem> data{test::item("flow", std::vector{0.0})};
    if (allKinds) {
        data.push_back(test::item("label", std::vector<std::string>{"idle"}));
        data.push_back(test::item("on", std::vector{false}));
        data.push_back(test::item("steps", std::vector<std::int64_t>{0, 0}));
    }
    Type& pump = made.type("Pump", Role::Active, std::move(data));
    const Rule& out = made.rule(pump, "out", Direction::Output);
    const Type& signal =
        made.type("Signal", Role::Modification, {test::item("value", std::vector{0.0})});
    Pumps pumps;
    for (std::uint32_t i = 0; i < pumpCount; ++i) {
        made.add("/p" + std::to_string(1000 + i), pump);
    }
    pumps.signal = made.add("/signal", signal);
    made.relate(0, out, pumps.signal);
    pumps.structure = made.build();
    return pumps;
}

Indices range(std::uint32_t first, std::uint32_t end) {
    Indices result;
    for (std::uint32_t i = first; i < end; ++i) result.push_back(i);
    return result;
}

ImageParts divide(const Tables& tables, const std::vector<Indices>& groups) {
    return divideImage(tables,
                       std::vector<std::span<const std::uint32_t>>{groups.begin(), groups.end()});
}

// How often each octet of the arena is copied by groups or at the end; texts have a way of their
// own.
std::vector<int> timesCopied(const Tables& tables, const ImageParts& image) {
    std::vector<int> times(tables.arena().size());
    const auto count = [&](const std::vector<ImageParts::Part>& parts) {
        for (const auto& [offset, octets] : parts) {
            ASSERT_LE(offset + octets, times.size());
            for (std::size_t i = offset; i < offset + octets; ++i) ++times[i];
        }
    };
    count(image.parts);
    count(image.rest);
    const auto [texts, octets] = tables.textsInArena();
    for (std::size_t i = texts; i < texts + octets; ++i) ++times[i];
    return times;
}

TEST(ImageParts, CoverEveryOctetOfTheTablesOnceHoweverTasksAreGrouped) {
    std::mt19937 random{7};
    for (int round = 0; round < 80; ++round) {
        const Pumps pumps = makePumps(round % 4 < 2);  // blocks of kinds may touch
        const Tables tables{pumps.structure};
        Indices tasks = range(0, pumpCount);
        if (round % 2 == 1) std::ranges::shuffle(tasks, random);
        tasks.resize(random() % (pumpCount + 1));
        std::vector<Indices> groups(1 + random() % 5);
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            groups[i * groups.size() / tasks.size()].push_back(tasks[i]);
        }
        const std::vector<int> times = timesCopied(tables, divide(tables, groups));
        ASSERT_EQ(std::ranges::count(times, 1), std::ssize(times)) << round;
    }
}

TEST(ImageParts, AreLeftToTheEndOfTheCycleWithoutGroups) {
    const Pumps pumps = makePumps();
    const Tables tables{pumps.structure};
    const ImageParts image = divide(tables, {});

    EXPECT_TRUE(image.parts.empty());
    EXPECT_TRUE(image.of(0).empty());
    EXPECT_EQ(image.rest.size(), 2U);  // before the texts and after them
}

TEST(ImageParts, AreLeftToTheEndWhereWhatAGroupWritesDoesNotLieTogether) {
    const Pumps pumps = makePumps();
    const Tables tables{pumps.structure};
    std::vector<Indices> inTurn(2);
    for (std::uint32_t i = 0; i < pumpCount; ++i) inTurn[i % 2].push_back(i);

    EXPECT_TRUE(divide(tables, inTurn).parts.empty());
}

TEST(ImageParts, AreLeftToTheEndWhereOtherTasksWriteThem) {
    const Pumps pumps = makePumps();
    const Tables tables{pumps.structure};
    const ImageParts image = divide(tables, {range(0, pumpCount + 1)});  // the signal as well
    const auto place = static_cast<std::size_t>(
        reinterpret_cast<const std::byte*>(tables.live(pumps.signal).floats) -
        tables.arena().data());

    ASSERT_FALSE(image.parts.empty());
    for (const auto& [offset, octets] : image.parts) {
        EXPECT_FALSE(offset <= place && place < offset + octets);
    }
}

class DividedImage : public ::testing::Test {
protected:
    double& flow(std::uint32_t pump) { return tables.live(pump).floats[0]; }
    double flowSeen(std::uint32_t pump) {
        return pool.newest().get<double>("/p" + std::to_string(1000 + pump), "flow");
    }

    Pumps pumps = makePumps();
    Tables tables{pumps.structure};
    ImagePool pool{tables, 2};
    ImageParts image = divide(tables, {range(0, half), range(half, pumpCount)});
};

// What comes later could only be seen in a part that is copied at the end.
TEST_F(DividedImage, ShowsWhatAGroupHadWrittenWhenItWasCopied) {
    pool.divide(image);
    for (int cycle = 1; cycle < 10; ++cycle) {
        flow(3) = flow(half) = cycle;
        *tables.live(pumps.signal).floats = cycle;
        pool.copyGroup(0);
        pool.copyGroup(1);
        flow(3) = flow(half) = -1;
        *tables.live(pumps.signal).floats = 2 * cycle;
        pool.publish(cycle, 0, 0);

        EXPECT_EQ(flowSeen(3), cycle);
        EXPECT_EQ(flowSeen(half), cycle);
        EXPECT_EQ(pool.newest().get<double>("/signal", "value"), 2 * cycle);
    }
}

TEST_F(DividedImage, IsCopiedAtOnceAgainAfterwards) {
    pool.divide(image);
    pool.copyAtOnce();
    for (int cycle = 1; cycle < 5; ++cycle) {
        flow(3) = cycle;
        pool.publish(cycle, 0, 0);
        EXPECT_EQ(flowSeen(3), cycle);
    }
}

TEST_F(DividedImage, LeavesImagesThatAreHeldAsTheyAre) {
    pool.divide(image);
    std::vector<Image> held;
    for (int cycle = 1; cycle < 20; ++cycle) {
        flow(3) = cycle;
        pool.copyGroup(0);
        pool.copyGroup(1);
        pool.publish(cycle, 0, 0);
        if (cycle == 5 || cycle == 6) held.push_back(pool.newest());
    }
    EXPECT_EQ(held[0].get<double>("/p1003", "flow"), 5);
    EXPECT_EQ(held[1].get<double>("/p1003", "flow"), 6);
}

}  // namespace
}  // namespace cortex
