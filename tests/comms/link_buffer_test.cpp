// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_link_buffer.hpp"
#include "support/small_structure.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

struct Values : testing::Test {
    test::Plant plant = test::makePlant();
    const TypeLayout& layout = *plant.structure->simplexes[plant.axis].layout;
};

TEST_F(Values, OfASimplexTravelByKind) {
    SliceMemory from{layout};
    from.slice().floats[0] = 1.5;
    from.slice().ints[0] = -3;
    from.slice().bools[0] = true;
    from.slice().state->quality = Quality::Stale;
    from.slice().state->time = 17;
    SimplexData data;
    readValues(plant.axis, layout, from.slice(), data);
    EXPECT_EQ(data.index, plant.axis);
    EXPECT_EQ(data.floats.size(), layout.cyclic.floats);
    EXPECT_EQ(data.strings, (std::vector<std::string>{"axis", "a", "b"}));
    data.strings = {"arm", "", "wxyz"};

    ASSERT_EQ(misfit(data, layout), "");
    SliceMemory to{layout};
    storeValues(data, layout, to.slice());
    SimplexData again;
    readValues(plant.axis, layout, to.slice(), again);
    EXPECT_EQ(again, data);
}

TEST_F(Values, ThatAreTooManyTooFewOrTooLongDoNotFit) {
    SliceMemory memory{layout};
    SimplexData good;
    readValues(0, layout, memory.slice(), good);
    ASSERT_EQ(misfit(good, layout), "");
    const auto changed = [&](auto change) {
        SimplexData data = good;
        change(data);
        return misfit(data, layout);
    };
    const std::string ints = std::to_string(good.ints.size());
    EXPECT_EQ(changed([](SimplexData& data) { data.ints.clear(); }), "0 ints instead of " + ints);
    EXPECT_NE(changed([](SimplexData& data) { data.floats.push_back(0); }), "");
    EXPECT_NE(changed([](SimplexData& data) { data.bools.clear(); }), "");
    EXPECT_EQ(changed([](SimplexData& data) { data.strings.pop_back(); }),
              "2 strings instead of 3");
    EXPECT_EQ(changed([](SimplexData& data) { data.strings[1] = "longer"; }),
              "a string of 6 octets instead of 4 at most");
    EXPECT_EQ(changed([](SimplexData& data) { data.quality = 4; }), "a quality that cannot be");
}

TEST_F(Values, AreNeverTooOldToFitButTheirStampIsANumberThatCanBe) {
    SliceMemory memory{layout};
    SimplexData data;
    readValues(0, layout, memory.slice(), data);
    constexpr std::int64_t farthest = std::int64_t{1} << 60U;
    for (const std::int64_t time : {std::int64_t{-1}, 1 - farthest, farthest - 1}) {
        data.time = time;
        EXPECT_EQ(misfit(data, layout), "") << time;
    }
    for (const std::int64_t time :
         {-farthest, farthest, std::numeric_limits<std::int64_t>::min()}) {
        data.time = time;
        EXPECT_EQ(misfit(data, layout), "a stamp that cannot be") << time;
    }
}

TEST_F(Values, OfConstantItemsStandInMemoryOfTheirOwn) {
    const SliceMemory constants{layout, true};

    EXPECT_EQ(constants.slice().floats[0], 0.1);
    EXPECT_EQ(reinterpret_cast<const StringCell*>(constants.slice().strings)->view(), "S1");
}

// Writes a sample of that number whose values say so as well.
void write(LinkBuffer& buffer, std::size_t place, std::uint64_t number) {
    LinkBuffer::Sample& sample = buffer.writable(place);
    sample.number = number;
    sample.values.slice().floats[0] = static_cast<double>(number);
    sample.values.slice().state->cycle = static_cast<std::int64_t>(number);
}
// The numbers of all samples; 0 where the values are not those of the number.
std::vector<std::uint64_t> numbers(const LinkBuffer::Samples& samples) {
    std::vector<std::uint64_t> all;
    for (const LinkBuffer::Sample& each : samples) {
        const auto number = static_cast<std::uint64_t>(each.values.slice().floats[0]);
        const auto cycle = static_cast<std::uint64_t>(each.values.slice().state->cycle);
        all.push_back(number == each.number && cycle == number ? number : 0);
    }
    return all;
}

using Numbers = std::vector<std::uint64_t>;

TEST_F(Values, BufferHandsOutTheNewestSampleOfEachSimplex) {
    LinkBuffer buffer{{&layout, &layout, &layout}};
    EXPECT_EQ(buffer.take()[0].number, 0U) << "nothing has come";
    for (const std::uint64_t number : {1U, 2U}) {
        for (std::size_t place = 0; place < 3; ++place) write(buffer, place, number);
        buffer.publish();
    }
    EXPECT_EQ(numbers(buffer.take()), (Numbers{2, 2, 2}));
    EXPECT_EQ(numbers(buffer.take()), (Numbers{2, 2, 2}));
    write(buffer, 1, 3);
    buffer.publish();
    write(buffer, 2, 4);
    EXPECT_EQ(numbers(buffer.take()), (Numbers{2, 3, 2})) << "it is not published yet";
    buffer.publish();
    write(buffer, 0, 5);
    buffer.publish();
    EXPECT_EQ(numbers(buffer.take()), (Numbers{5, 3, 4}));
}

// One simplex is written in each cycle, another in every second, the last in every fifth.
TEST_F(Values, WhatTheBufferHandsOutIsOfOneCycle) {
    constexpr std::uint64_t last = 20'000;
    LinkBuffer buffer{{&layout, &layout, &layout}};
    std::thread writer{[&] {
        for (std::uint64_t number = 10; number <= last; ++number) {
            write(buffer, 0, number);
            if (number % 2 == 0) write(buffer, 1, number);
            if (number % 5 == 0) write(buffer, 2, number);
            buffer.publish();
        }
    }};
    std::uint64_t newest = 0;
    while (newest < last && !HasFailure()) {
        const LinkBuffer::Samples& samples = buffer.take();
        const std::uint64_t number = samples[0].number;
        if (number == 0) continue;
        EXPECT_GE(number, newest);
        EXPECT_EQ(numbers(samples), (Numbers{number, number - number % 2, number - number % 5}));
        newest = number;
    }
    writer.join();
}

}  // namespace
}  // namespace cortex::comms
