// SPDX-License-Identifier: Apache-2.0
// The registers of a drive on Modbus, by octets that were written by hand, and there and back.
#include "drive/ds402_registers.hpp"

#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>

#include <gtest/gtest.h>

namespace cortex::modbus::test {
namespace {

constexpr WordOrder bothOrders[] = {WordOrder::HighWordFirst, WordOrder::LowWordFirst};
constexpr std::uint32_t seed = 402;
constexpr int rounds = 300;

// As they go over the wire, high octet first: "0237 0008".
std::string octets(std::span<const std::uint16_t> words) {
    std::string text;
    char word[8];
    for (const std::uint16_t each : words) {
        std::snprintf(word, sizeof word, "%s%04X", text.empty() ? "" : " ", each);
        text += word;
    }
    return text;
}

template <std::size_t count>
std::string octets(const std::array<std::uint16_t, count>& words, std::size_t from,
                   std::size_t how) {
    return octets(std::span{words}.subspan(from, how));
}

class RandomWords {
public:
    template <std::size_t count>
    std::array<std::uint16_t, count> words() {
        std::array<std::uint16_t, count> all{};
        for (std::uint16_t& each : all) each = static_cast<std::uint16_t>(random_());
        return all;
    }
    std::int32_t number() { return static_cast<std::int32_t>(random_()); }

private:
    std::mt19937 random_{seed};
};

Ds402Told someTold() {
    Ds402Told told;
    told.axes[0] = {0x000F, 8, -2, 0x01020304, -1, 500, -65536, 0xA5A5};
    told.axes[1] = {0x0006, -3,    0x7FFFFFFF, std::numeric_limits<std::int32_t>::min(),
                    1000,   -1000, 1,          0x0001};
    told.heartbeat = 0xBEEF;
    return told;
}

TEST(Ds402Registers, TellADriveAsWrittenByHand) {
    const Ds402TellImage image = encode(someTold(), WordOrder::HighWordFirst);

    EXPECT_EQ(octets(image, 0x00, 16),
              "000F 0008 FFFF FFFE 0102 0304 FFFF 01F4 FFFF 0000 A5A5 0000 0000 0000 0000 0000");
    EXPECT_EQ(octets(image, 0x10, 16),
              "0006 FFFD 7FFF FFFF 8000 0000 03E8 FC18 0000 0001 0001 0000 0000 0000 0000 0000");
    EXPECT_EQ(octets(image, 0x20, 2), "BEEF 0000");
}

TEST(Ds402Registers, SwapTheWordsOfNumbersAloneInTheOtherOrder) {
    const Ds402TellImage image = encode(someTold(), WordOrder::LowWordFirst);

    EXPECT_EQ(octets(image, 0x00, 11), "000F 0008 FFFE FFFF 0304 0102 FFFF 01F4 0000 FFFF A5A5");
    EXPECT_EQ(octets(image, 0x20, 2), "BEEF 0000");
}

TEST(Ds402Registers, ShowADriveAsWrittenByHand) {
    Ds402Seen seen;
    seen.axes[0] = {0x1637,     8,      -100000, 314159, -250, 0x8611, 2,
                    0x00050003, -99998, -125,    16,     9,    1,      300};
    seen.axes[1].statusWord = 0x0250;
    seen.heartbeat = 0x0102;
    seen.time = 0xDEADBEEF;

    const Ds402SeeImage image = encode(seen, WordOrder::HighWordFirst);

    EXPECT_EQ(octets(image, 0x00, 24),
              "1637 0008 FFFE 7960 0004 CB2F FF06 8611 0000 0002 0005 0003 FFFE 7962 FF83 0910 "
              "0001 012C 0000 0000 0000 0000 0000 0000");
    EXPECT_EQ(octets(image, 0x18, 4), "0250 0000 0000 0000");
    EXPECT_EQ(octets(image, 0x30, 4), "0102 DEAD BEEF 0002");
    EXPECT_EQ(decode(image, WordOrder::HighWordFirst), seen);
}

TEST(Ds402Registers, IdentifyADriveAsWrittenByHand) {
    Ds402Identity identity;
    identity.axes = 2;
    identity.countsPerUnit = {100000, -0.1};
    identity.serial = 0x00010203;

    const Ds402IdentityImage image = encode(identity, WordOrder::HighWordFirst);

    EXPECT_EQ(octets(image),
              "4358 3032 0002 0000 40F8 6A00 0000 0000 BFB9 9999 9999 999A 0001 0203");
    EXPECT_EQ(octets(encode(identity, WordOrder::LowWordFirst)),
              "3032 4358 0002 0000 0000 0000 6A00 40F8 999A 9999 9999 BFB9 0203 0001");
    for (const WordOrder order : bothOrders)
        EXPECT_EQ(decode(encode(identity, order), order), identity);
}

// What is to be 0 is lost, the rest is not: once decoded it stays the same.
template <class Image>
void expectKept(RandomWords& random, WordOrder order) {
    const Image any = random.words<std::tuple_size_v<Image>>();
    const auto meaning = decode(any, order);
    const Image clean = encode(meaning, order);
    EXPECT_EQ(decode(clean, order), meaning) << octets(any);
    EXPECT_EQ(encode(decode(clean, order), order), clean) << octets(any);
}

TEST(Ds402Registers, GoThereAndBackWithAnyContents) {
    RandomWords random;
    for (int i = 0; i < rounds; ++i) {
        for (const WordOrder order : bothOrders) {
            expectKept<Ds402TellImage>(random, order);
            expectKept<Ds402SeeImage>(random, order);
        }
    }
}

TEST(Ds402Registers, NameAnIdentityOfAnyContents) {
    RandomWords random;
    for (int i = 0; i < rounds; ++i) {
        const auto any = random.words<Ds402Map::identityCount>();
        EXPECT_EQ(decode(any, WordOrder::HighWordFirst).text().size(), 4U);
        EXPECT_EQ(decode(any, WordOrder::HighWordFirst).axes, any[2]);
    }
}

TEST(Ds402Registers, HoldParametersInCountsAndThousandths) {
    drives::Ds402Parameters parameters;
    parameters.countsPerUnit = 10430.378350470453;  // 65536 a turn
    parameters.followingErrorWindow = 0.1;
    parameters.followingErrorTime = 0.05;
    parameters.softMin = -3;
    parameters.homingMethod = -1;

    const Ds402ParameterImage image = encode(parameters);

    const auto valueOf = [&](std::uint16_t object, std::uint8_t sub) {
        for (std::size_t i = 0; i < image.size(); ++i)
            if (ds402ParameterRows()[i].object == object && ds402ParameterRows()[i].sub == sub)
                return image[i];
        ADD_FAILURE() << object;
        return 0;
    };
    EXPECT_EQ(valueOf(0x605A, 0), 2);
    EXPECT_EQ(valueOf(0x6065, 0), 1043);
    EXPECT_EQ(valueOf(0x6066, 0), 50);
    EXPECT_EQ(valueOf(0x6076, 0), 10000);
    EXPECT_EQ(valueOf(0x607D, 1), -31291);
    EXPECT_EQ(valueOf(0x608F, 0), 10430);
    EXPECT_EQ(valueOf(0x6098, 0), -1);
    EXPECT_EQ(valueOf(0x6502, 0), 0x3A5);
    EXPECT_EQ(image[0], 2) << "the order begins with 605A";
    EXPECT_EQ(image.back(), 0x3A5) << "and ends with 6502";
}

TEST(Ds402Registers, ChangeOnlyTheParametersThatAreWritten) {
    drives::Ds402Parameters before;
    before.countsPerUnit = 10430.378350470453;
    Ds402ParameterImage image = encode(before);
    image[13] = 2086;  // 6081, profile velocity
    image[16] = 5;     // 608F, which is fixed

    const drives::Ds402Parameters after = decode(image, before);

    EXPECT_NEAR(after.profileVelocity, 0.2, 1e-4);
    EXPECT_EQ(after.countsPerUnit, before.countsPerUnit);
    EXPECT_EQ(after.homingSpeed, before.homingSpeed) << "bit for bit";
    EXPECT_EQ(after.followingErrorWindow, before.followingErrorWindow);
}

TEST(Ds402Registers, ClampParametersThatTheyCannotHoldAndNameThem) {
    drives::Ds402Parameters parameters;
    EXPECT_EQ(firstBeyond(parameters), nullptr);
    parameters.homeOffset = -1e9;
    ASSERT_NE(firstBeyond(parameters), nullptr);
    EXPECT_EQ(firstBeyond(parameters)->name, "home offset");
    EXPECT_EQ(encode(parameters)[9], std::numeric_limits<std::int32_t>::min());
    parameters.homeOffset = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(firstBeyond(parameters), nullptr);
    encode(parameters);

    RandomWords random;
    for (int i = 0; i < rounds; ++i) {
        Ds402ParameterImage any{};
        for (std::int32_t& each : any) each = random.number();
        const drives::Ds402Parameters meaning = decode(any, {});
        EXPECT_EQ(decode(encode(meaning), meaning).homeOffset, meaning.homeOffset);
    }
}

}  // namespace
}  // namespace cortex::modbus::test
