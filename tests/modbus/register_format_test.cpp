// SPDX-License-Identifier: Apache-2.0
#include "register_format.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using enum RegisterFormat;
using enum WordOrder;

struct Case {
    RegisterFormat format;
    WordOrder order;
    double counts;
    std::vector<std::uint16_t> words;
};

// 1.5 is 3FC0'0000; -1.5 is BFC0'0000, IEEE 754.
const std::vector<Case> cases{
    {Signed16, HighWordFirst, 0, {0x0000}},
    {Signed16, HighWordFirst, 32767, {0x7FFF}},
    {Signed16, LowWordFirst, -1, {0xFFFF}},
    {Signed16, HighWordFirst, -32768, {0x8000}},
    {Unsigned16, HighWordFirst, 65535, {0xFFFF}},
    {Unsigned16, LowWordFirst, 0x1234, {0x1234}},
    {Signed32, HighWordFirst, 0x12345678, {0x1234, 0x5678}},
    {Signed32, LowWordFirst, 0x12345678, {0x5678, 0x1234}},
    {Signed32, HighWordFirst, -2, {0xFFFF, 0xFFFE}},
    {Signed32, LowWordFirst, -2147483648.0, {0x0000, 0x8000}},
    {Unsigned32, HighWordFirst, 4294967295.0, {0xFFFF, 0xFFFF}},
    {Unsigned32, LowWordFirst, 65536, {0x0000, 0x0001}},
    {Float32, HighWordFirst, 1.5, {0x3FC0, 0x0000}},
    {Float32, LowWordFirst, -1.5, {0x0000, 0xBFC0}},
};

TEST(RegisterFormat, IsTheSameBothWaysInEachOrderOfWords) {
    for (const Case& each : cases) {
        ASSERT_EQ(wordsOf(each.format), each.words.size());
        std::vector<std::uint16_t> words(each.words.size(), 0xAAAA);
        EXPECT_EQ(putCounts(each.counts, each.format, each.order, words), each.counts);
        EXPECT_EQ(words, each.words) << each.counts;
        EXPECT_EQ(countsIn(words, each.format, each.order), each.counts);
        EXPECT_TRUE(holds(each.counts, each.format));
    }
}

TEST(RegisterFormat, HoldsTheNearestOfWhatIsBeyondAndNeverWrapsAround) {
    struct Beyond {
        RegisterFormat format;
        double counts, put;
        bool isHeld;
    };
    for (const Beyond& each :
         {Beyond{Signed16, 32768, 32767, false}, Beyond{Signed16, -40000, -32768, false},
          Beyond{Signed16, 32767.4, 32767, true}, Beyond{Signed16, 2.5, 3, true},
          Beyond{Unsigned16, -1, 0, false}, Beyond{Unsigned16, -0.4, 0, true},
          Beyond{Unsigned16, 1e300, 65535, false}, Beyond{Signed32, 1e300, 2147483647, false},
          Beyond{Signed32, -1e300, -2147483648.0, false}, Beyond{Unsigned32, -5, 0, false},
          Beyond{Unsigned32, 4294967296.0, 4294967295.0, false},
          Beyond{Float32, 1e300, static_cast<double>(std::numeric_limits<float>::max()), false},
          Beyond{Float32, 0.1, static_cast<double>(0.1F), true}}) {
        std::array<std::uint16_t, 2> words{};
        EXPECT_EQ(putCounts(each.counts, each.format, HighWordFirst, words), each.put);
        EXPECT_EQ(countsIn(words, each.format, HighWordFirst), each.put);
        EXPECT_EQ(holds(each.counts, each.format), each.isHeld) << each.counts;
    }
}

TEST(ScaledRegisters, StandOneBehindTheOtherEachWithItsScale) {
    const ScaledRegisters registers{0, Signed32, LowWordFirst, {0.001, -2}, {0, 10}};
    ASSERT_EQ(registers.words(), 4U);
    std::array<std::uint16_t, 4> words{};

    EXPECT_EQ(registers.write(0, -0.002, words), -0.002);
    EXPECT_EQ(registers.write(1, 4, words), 4);

    EXPECT_EQ(words, (std::array<std::uint16_t, 4>{0xFFFE, 0xFFFF, 3, 0}));
    EXPECT_EQ(registers.read(0, words), -0.002);
    EXPECT_EQ(registers.read(1, words), 4);
    EXPECT_TRUE(registers.holds(1, 4e9));
    EXPECT_FALSE(registers.holds(1, 5e9));
    EXPECT_EQ(registers.write(1, 5e9, words), 10 + 2147483648.0 * 2)
        << "nearest, as scale is below 0";
}

}  // namespace
}  // namespace cortex::modbus::test
