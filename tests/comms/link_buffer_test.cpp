// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_link_buffer.hpp"
#include "support/small_structure.hpp"

#include <atomic>
#include <limits>
#include <string>
#include <thread>

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

TEST_F(Values, BufferHandsOutTheNewestOnce) {
    LinkBuffer buffer{layout};
    EXPECT_EQ(buffer.take(), nullptr);
    for (const std::int64_t age : {1, 2}) {
        buffer.writable().age = age;
        buffer.publish();
    }
    const LinkBuffer::Sample* sample = buffer.take();

    ASSERT_NE(sample, nullptr);
    EXPECT_EQ(sample->age, 2);
    EXPECT_EQ(buffer.take(), nullptr);
}

TEST_F(Values, BufferNeverHandsOutHalfASample) {
    constexpr std::int64_t last = 20'000;
    LinkBuffer buffer{layout};
    std::thread writer{[&] {
        for (std::int64_t number = 1; number <= last; ++number) {
            LinkBuffer::Sample& sample = buffer.writable();
            sample.age = number;
            sample.values.slice().floats[0] = static_cast<double>(number);
            buffer.publish();
        }
    }};
    std::int64_t newest = 0;
    while (newest < last) {
        const LinkBuffer::Sample* sample = buffer.take();
        if (sample == nullptr) continue;
        ASSERT_GT(sample->age, newest);
        ASSERT_EQ(sample->values.slice().floats[0], static_cast<double>(sample->age));
        newest = sample->age;
    }
    writer.join();
}

}  // namespace
}  // namespace cortex::comms
