// SPDX-License-Identifier: Apache-2.0
#include "cortex/drives/ds402_pdo.hpp"

#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::drives::test {
namespace {

using Image = std::array<std::byte, Ds402Pdo::size>;

Image octets(const std::array<int, Ds402Pdo::size>& numbers) {
    Image image;
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<std::byte>(numbers[i]);
    return image;
}

const Ds402RxPdo command{0x010F, 0x12345678, -2, -1000, 8};
const Image commandImage =
    octets({0x0F, 0x01, 0x78, 0x56, 0x34, 0x12, 0xFE, 0xFF, 0xFF, 0xFF, 0x18, 0xFC, 0x08, 0x00});
const Ds402TxPdo answer{0x1637, -100000, 2000000000, 999, -1};
const Image answerImage =
    octets({0x37, 0x16, 0x60, 0x79, 0xFE, 0xFF, 0x00, 0x94, 0x35, 0x77, 0xE7, 0x03, 0xFF, 0x00});

TEST(Ds402Pdo, PacksWhatAMasterSendsAsTheOctetsThatAreWrittenByHand) {
    Image image{};
    image.fill(std::byte{0xAA});

    EXPECT_TRUE(Ds402Pdo::pack(command, image));

    EXPECT_EQ(image, commandImage);
}

TEST(Ds402Pdo, PacksWhatADriveSendsAsTheOctetsThatAreWrittenByHand) {
    Image image{};
    image.fill(std::byte{0xAA});

    EXPECT_TRUE(Ds402Pdo::pack(answer, image));

    EXPECT_EQ(image, answerImage);
}

TEST(Ds402Pdo, UnpacksBothImages) {
    Ds402RxPdo received;
    Ds402TxPdo read;

    EXPECT_TRUE(Ds402Pdo::unpack(commandImage, received));
    EXPECT_TRUE(Ds402Pdo::unpack(answerImage, read));

    EXPECT_EQ(received, command);
    EXPECT_EQ(read, answer);
}

TEST(Ds402Pdo, DoesNotLookAtThePadding) {
    Image image = answerImage;
    image[13] = std::byte{0x55};
    Ds402TxPdo read;

    EXPECT_TRUE(Ds402Pdo::unpack(image, read));

    EXPECT_EQ(read, answer);
}

TEST(Ds402Pdo, RefusesEachShorterBufferAndLeavesItAsItIs) {
    for (std::size_t length = 0; length < Ds402Pdo::size; ++length) {
        std::vector<std::byte> buffer(length, std::byte{0x5A});  // its end is watched
        Ds402RxPdo received = command;
        Ds402TxPdo read = answer;

        EXPECT_FALSE(Ds402Pdo::pack(command, buffer));
        EXPECT_FALSE(Ds402Pdo::pack(answer, buffer));
        EXPECT_FALSE(Ds402Pdo::unpack(buffer, received));
        EXPECT_FALSE(Ds402Pdo::unpack(buffer, read));

        EXPECT_EQ(buffer, std::vector<std::byte>(length, std::byte{0x5A}));
        EXPECT_EQ(received, command);
        EXPECT_EQ(read, answer);
    }
}

TEST(Ds402Pdo, LeavesWhatStandsBehindTheImage) {
    std::vector<std::byte> buffer(20, std::byte{0x5A});

    EXPECT_TRUE(Ds402Pdo::pack(command, buffer));

    for (std::size_t i = Ds402Pdo::size; i < buffer.size(); ++i)
        EXPECT_EQ(buffer[i], std::byte{0x5A});
}

TEST(Ds402Pdo, KeepsTheGreatestAndTheLeastNumbers) {
    using Most = std::numeric_limits<std::int32_t>;
    for (const Ds402TxPdo& each : {Ds402TxPdo{0xFFFF, Most::max(), Most::max(), 32767, 127},
                                   Ds402TxPdo{0, Most::min(), Most::min(), -32768, -128}}) {
        Image image;
        Ds402TxPdo read;
        ASSERT_TRUE(Ds402Pdo::pack(each, image));
        ASSERT_TRUE(Ds402Pdo::unpack(image, read));
        EXPECT_EQ(read, each);
    }
}

TEST(Ds402Scale, RoundsToWholeCountsAndPerMille) {
    const Ds402Scale scale{1000, 20};

    EXPECT_EQ(scale.counts(1.2346), 1235);
    EXPECT_EQ(scale.counts(-1.2346), -1235);
    EXPECT_DOUBLE_EQ(scale.value(-1235), -1.235);
    EXPECT_EQ(scale.perMille(-10), -500);
    EXPECT_DOUBLE_EQ(scale.effort(1500), 30);
}

TEST(Ds402Scale, IsEmptyForWhatDoesNotFit) {
    const Ds402Scale scale{1e6, 1};

    EXPECT_EQ(scale.counts(2147.483647), 2147483647);
    EXPECT_EQ(scale.counts(2147.483648), std::nullopt);
    EXPECT_EQ(scale.counts(-2147.483648), -2147483647 - 1);
    EXPECT_EQ(scale.counts(-2147.48365), std::nullopt);
    EXPECT_EQ(scale.counts(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
    EXPECT_EQ(scale.perMille(32.768), std::nullopt);
    EXPECT_EQ(scale.perMille(-std::numeric_limits<double>::infinity()), std::nullopt);
}

}  // namespace
}  // namespace cortex::drives::test
