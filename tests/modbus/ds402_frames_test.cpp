// SPDX-License-Identifier: Apache-2.0
// Requests of Modbus/TCP as octets: good ones, wrong ones, any.
#include "modbus/sim_process.hpp"
#include "sim/modbus_frames.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

using sim::Exception;
using sim::Frame;
using sim::Inbox;

// Eight registers at address 16, which are all there is.
class EightRegisters final : public sim::Registers {
public:
    std::array<std::uint16_t, 8> words{1, 2, 3, 4, 5, 6, 7, 8};

    Exception read(std::uint16_t first, std::span<std::uint16_t> to) override {
        if (!holds(first, to.size())) return Exception::Address;
        std::copy_n(&words[first - 16U], to.size(), to.begin());
        return Exception::None;
    }
    Exception write(std::uint16_t first, std::span<const std::uint16_t> values) override {
        if (!holds(first, values.size())) return Exception::Address;
        std::ranges::copy(values, &words[first - 16U]);
        return Exception::None;
    }

private:
    static bool holds(std::size_t first, std::size_t count) {
        return first >= 16 && first + count <= 24;
    }
};

class FramesOfSim : public testing::Test {
protected:
    Octets answer(const Octets& request) { return answerTo(request, registers); }

    EightRegisters registers;
};

TEST_F(FramesOfSim, AnswerReadingAsTheSpecificationHasIt) {
    EXPECT_EQ(answer({3, 0, 16, 0, 2}), (Octets{3, 4, 0, 1, 0, 2}));
    EXPECT_EQ(answer({4, 0, 23, 0, 1}), (Octets{4, 2, 0, 8}));
}

TEST_F(FramesOfSim, AnswerWritingAsTheSpecificationHasIt) {
    EXPECT_EQ(answer({6, 0, 17, 0xAB, 0xCD}), (Octets{6, 0, 17, 0xAB, 0xCD}));
    EXPECT_EQ(answer({16, 0, 18, 0, 2, 4, 1, 2, 3, 4}), (Octets{16, 0, 18, 0, 2}));
    EXPECT_EQ(registers.words,
              (std::array<std::uint16_t, 8>{1, 0xABCD, 0x0102, 0x0304, 5, 6, 7, 8}));
}

TEST_F(FramesOfSim, WriteBeforeTheyReadInOneRequest) {
    EXPECT_EQ(answer({23, 0, 16, 0, 2, 0, 17, 0, 1, 2, 0x55, 0xAA}),
              (Octets{23, 4, 0, 1, 0x55, 0xAA}));
}

TEST_F(FramesOfSim, RefuseWithTheExceptionThatFitsAndChangeNothing) {
    const auto before = registers.words;
    const std::pair<Octets, int> wrong[] = {
        {{1, 0, 16, 0, 1}, 1},
        {{2, 0, 16, 0, 1}, 1},
        {{5, 0, 16, 0xFF, 0}, 1},
        {{15, 0, 16, 0, 1, 1, 1}, 1},
        {{0x2B, 14, 1, 0}, 1},
        {{0}, 1},
        {{3, 0, 15, 0, 1}, 2},
        {{3, 0, 16, 0, 9}, 2},
        {{3, 0xFF, 0xFF, 0, 2}, 2},
        {{6, 0, 24, 0, 1}, 2},
        {{16, 0, 23, 0, 2, 4, 1, 2, 3, 4}, 2},
        {{3, 0, 16, 0, 0}, 3},
        {{3, 0, 16, 0, 126}, 3},
        {{3, 0, 16, 0}, 3},
        {{3, 0, 16, 0, 1, 0}, 3},
        {{3}, 3},
        {{6, 0, 16, 1}, 3},
        {{16, 0, 16, 0, 0, 0}, 3},
        {{16, 0, 16, 0, 1, 2, 1}, 3},
        {{16, 0, 16, 0, 1, 3, 1, 2, 3}, 3},
        {{16, 0, 16, 0, 124, 248}, 3},
        {{16, 0, 16}, 3},
        {{23, 0, 16, 0, 0, 0, 16, 0, 1, 2, 9, 9}, 3},
        {{23, 0, 16, 0, 1, 0, 16, 0, 1, 4, 9, 9}, 3},
        {{23, 0, 16, 0, 1, 0, 16, 0, 0, 0}, 3},
        {{23, 0, 16, 0, 1}, 3},
    };
    for (const auto& [request, exception] : wrong) {
        EXPECT_EQ(answer(request), (Octets{static_cast<std::uint8_t>(request[0] | 0x80),
                                           static_cast<std::uint8_t>(exception)}))
            << testing::PrintToString(request);
    }
    EXPECT_EQ(answer({}), (Octets{0x80, 1}));
    EXPECT_EQ(registers.words, before);
}

TEST_F(FramesOfSim, AnswerAnyOctets) {
    std::mt19937 random{402};
    const std::uint8_t functions[] = {3, 4, 6, 16, 23};
    for (int i = 0; i < 20000; ++i) {
        Octets request(1 + random() % 30);
        for (std::uint8_t& each : request) each = static_cast<std::uint8_t>(random() % 32);
        if (i % 2 == 0) request[0] = functions[random() % 5];
        const Octets said = answer(request);
        ASSERT_GE(said.size(), 2U);
        EXPECT_EQ(said[0] & 0x7F, request[0] & 0x7F);
        if (said[0] & 0x80) EXPECT_LE(said[1], 3);
    }
}

TEST(InboxOfSim, TakesWholeRequestsOutOfPieces) {
    const Octets both{0, 7, 0, 0, 0, 6, 1, 3, 0, 16, 0, 1, 0, 8, 0, 0, 0, 2, 255, 7};
    Inbox inbox;
    std::vector<Frame> taken;
    for (const std::uint8_t octet : both) {
        inbox.add({&octet, 1});
        if (const auto frame = inbox.take()) taken.push_back(*frame);
    }
    ASSERT_EQ(taken.size(), 2U);
    EXPECT_EQ(taken[0].transaction, 7);
    EXPECT_EQ(taken[0].content, (Octets{3, 0, 16, 0, 1}));
    EXPECT_EQ(taken[1].unit, 255);
    EXPECT_EQ(taken[1].content, (Octets{7}));
    EXPECT_EQ(taken[0].onTheWire(), (Octets{0, 7, 0, 0, 0, 6, 1, 3, 0, 16, 0, 1}));
    EXPECT_FALSE(inbox.isSpoilt());
}

TEST(InboxOfSim, IsSpoiltByWhatIsNoModbus) {
    const Octets wrong[] = {
        {'G', 'E', 'T', ' ', '/', ' ', 'H', 'T'},  // another protocol
        {0, 1, 0, 1, 0, 2, 1, 3},                  // the same, although it looks alike
        {0, 1, 0, 0, 0, 0, 1, 3},                  // no length
        {0, 1, 0, 0, 0, 1, 1, 3},                  // nothing behind the unit
        {0, 1, 0, 0, 0, 255, 1, 3},                // longer than any request
        {0, 1, 0, 0, 0xFF, 0xFF, 1, 3},
    };
    for (const Octets& octets : wrong) {
        Inbox inbox;
        inbox.add(octets);
        EXPECT_FALSE(inbox.take());
        EXPECT_TRUE(inbox.isSpoilt()) << testing::PrintToString(octets);
        inbox.add(Octets{0, 1, 0, 0, 0, 2, 1, 3});
        EXPECT_FALSE(inbox.take()) << "nobody knows where it begins";
    }
}

}  // namespace
}  // namespace cortex::modbus::test
