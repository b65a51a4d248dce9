// SPDX-License-Identifier: Apache-2.0
// What the filter keeps of others, within bounds, and how our own datagrams are cut.
#include "comms/datagrams.hpp"
#include "rtps/datagram_filter.hpp"
#include "rtps/pieces.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::comms::bounds {
namespace {

using namespace datagrams;
using rtps::DatagramFilter;
using rtps::Refusal;

constexpr std::uint32_t address = 0x0a000007, large = 16u << 20;
constexpr std::int64_t second = 1'000'000'000;

rtps::WriterGuid guidOf(std::uint8_t prefix, std::uint32_t entity) {
    rtps::WriterGuid guid;
    guid.fill(prefix);
    for (std::size_t i = 0; i < 4; ++i) {
        guid[12 + i] = static_cast<std::uint8_t>(entity >> (24 - 8 * i));
    }
    return guid;
}

struct BoundsTest : testing::Test {
    DatagramFilter::Admitted admit(Datagram datagram) {
        return filter.admit(datagram, address, now);
    }
    std::size_t completed(const Fragment& fragment) {
        return admit(header() + dataFragment(fragment)).whole.size();
    }
    std::uint64_t unfinished() const { return filter.dropped(Refusal::Unfinished); }

    const rtps::WriterGuid writer = guidOf(1, anyWriter);
    DatagramFilter filter{rtps::Prefix{9, 9, 9}};
    std::int64_t now = second;
};

TEST_F(BoundsTest, AFragmentWaitsUntilItsSampleHasAll) {
    filter.allowFragments(writer, true, now);
    const Datagram time = submessage(0x09, 0, Datagram(8));
    const Datagram first = dataFragment({.number = 5}),
                   last = dataFragment({.number = 5, .first = 2});
    auto admitted = admit(header() + time + data(4) + first + heartbeat(1, 5));
    EXPECT_TRUE(admitted.whole.empty());
    EXPECT_EQ(admitted.left, (header() + time + data(4) + heartbeat(1, 5)).size());
    EXPECT_TRUE(admit(header() + first).whole.empty()) << "the same again";
    admitted = admit(header() + last);
    EXPECT_EQ(admitted.whole, (std::vector{header() + time + first, header() + last}));
    EXPECT_EQ(admitted.left, rtps::headerSize);
    EXPECT_EQ(unfinished(), 0U);
}

TEST_F(BoundsTest, FragmentsThatAreNotForThisParticipantStay) {
    filter.allowFragments(writer, true, now);
    const Datagram other = header() + submessage(0x0e, 0, Datagram(12, 3)) + dataFragment({});
    EXPECT_EQ(admit(other).left, other.size());
}

TEST_F(BoundsTest, BegunSamplesOfAWriterAreBoundedAndTold) {
    filter.allowFragments(writer, true, now);
    ASSERT_EQ(admit(header() + data(1)).whole.size(), 0U);
    for (int number = 1; number <= 100; ++number) {
        const auto admitted =
            admit(header() +
                  dataFragment(
                      {.number = number, .size = 1'000, .sample = large, .rest = Datagram(1'000)}));
        EXPECT_TRUE(admitted.whole.empty());
        EXPECT_EQ(admitted.left, rtps::headerSize) << "nothing of it reaches Fast DDS";
    }
    EXPECT_EQ(unfinished(), 100 - rtps::Fragments::mostOfWriter);
    EXPECT_EQ(filter.takeReports(now + second),
              std::vector<std::string>{"36 datagrams were dropped: they began more samples in "
                                       "fragments than there is room for; the last came from "
                                       "10.0.0.7"});
    // What is begun now goes on.
    EXPECT_EQ(completed({.number = 101}), 0U);
    EXPECT_EQ(completed({.number = 101, .first = 2}), 2U);
}

TEST_F(BoundsTest, AWriterThatFloodsDropsNothingOfAnother) {
    const rtps::WriterGuid other = guidOf(1, 0x203);
    filter.allowFragments(writer, true, now);
    filter.allowFragments(other, true, now);
    EXPECT_EQ(completed({.writer = 0x203}), 0U);
    for (int number = 1; number <= 1'000; ++number) EXPECT_EQ(completed({.number = number}), 0U);
    EXPECT_EQ(completed({.first = 2, .writer = 0x203}), 2U);
}

TEST(FragmentsTest, AllThatIsBegunIsBounded) {
    rtps::Fragments fragments;
    std::size_t most = 0;
    for (std::uint32_t i = 0; i < 2'000; ++i) {
        fragments.add({guidOf(1, i), 1, 1, 1, 60'000, large, true}, Datagram(60'000), second);
        most = std::max(most, fragments.bytes());
    }
    EXPECT_LE(most, rtps::Fragments::mostBytes + 100'000);
    EXPECT_GT(fragments.dropped(), 1'700U);
    // One sample of the greatest size has room beside nothing else.
    constexpr std::uint32_t count = large / 60'000 + 1;
    std::size_t whole = 0;
    for (std::uint32_t i = 1; i <= count; ++i) {
        whole =
            fragments.add({guidOf(2, 1), 1, i, 1, 60'000, large, true}, Datagram(60'000), second)
                .size();
    }
    EXPECT_EQ(whole, count);
    // What gets nothing for long is forgotten.
    fragments.add({guidOf(3, 1), 1, 1, 1, 8, 16, true}, Datagram(8), 60 * second);
    EXPECT_LT(fragments.bytes(), 1'000U);
    EXPECT_GT(fragments.incomplete(), 0U);
}

TEST(FragmentsTest, WhatAWriterDoesNotRepeatIsOverWithItsNextSample) {
    for (const bool comesAgain : {false, true}) {
        rtps::Fragments fragments;
        const auto add = [&](std::int64_t number, std::uint32_t first) {
            return fragments
                .add({guidOf(1, 1), number, first, 1, 8, 16, comesAgain}, Datagram(8), second)
                .size();
        };
        EXPECT_EQ(add(1, 1), 0U);
        EXPECT_EQ(add(2, 1), 0U);
        EXPECT_EQ(add(2, 2), 2U);
        EXPECT_EQ(fragments.incomplete(), comesAgain ? 0U : 1U);
        EXPECT_EQ(add(1, 2), comesAgain ? 2U : 0U);
        EXPECT_EQ(fragments.dropped(), 0U);
    }
}

// --- endpoints ----------------------------------------------------------------------------------

constexpr std::uint32_t ofWriters = 0x000003c2, ofReaders = 0x000004c2;

Datagram guidParameter(int id, std::uint8_t prefix, std::uint32_t entity) {
    const rtps::WriterGuid guid = guidOf(prefix, entity);
    return parameter(id, Datagram{guid.begin(), guid.end()});
}

struct EndpointsTest : BoundsTest {
    static Datagram endpoint(std::uint8_t participant, std::uint32_t entity,
                             const std::string& topic = "cortex/1/event") {
        return Datagram{0, 3, 0, 0} + guidParameter(0x5a, participant, entity) +
               parameter(0x05, text(topic)) + endOfList;
    }
    bool announce(std::uint8_t participant, std::uint32_t entity, std::uint32_t by = ofWriters) {
        return passes(participant, by, 4, endpoint(participant, entity));
    }
    bool dispose(std::uint8_t participant, std::uint32_t entity) {
        return passes(participant, ofWriters, 2,
                      guidParameter(0x70, participant, entity) +
                          parameter(0x71, Datagram{0, 0, 0, 3}) + endOfList);
    }
    bool passes(std::uint8_t participant, std::uint32_t by, int flags, const Datagram& content) {
        return admit(header(participant) + data(++number, by, flags, content)).left > 0;
    }
    std::int64_t number = 0;
    static constexpr int most = rtps::EndpointLimits::mostOfParticipant;
};

TEST_F(EndpointsTest, AParticipantAnnouncesSoManyAndNoMore) {
    int admitted = 0;
    for (std::uint32_t i = 0; i < 20'000; ++i)
        admitted += announce(1, i, i % 2 ? ofWriters : ofReaders);
    EXPECT_EQ(admitted, most);
    EXPECT_EQ(filter.dropped(Refusal::Endpoints), 20'000U - most);
    EXPECT_TRUE(announce(1, 3)) << "known";
    EXPECT_TRUE(announce(2, 3)) << "of another";
    EXPECT_TRUE(dispose(1, 3));
    EXPECT_TRUE(announce(1, 70'000));
    EXPECT_FALSE(announce(1, 3));
}

TEST_F(EndpointsTest, AllAnnounceSoManyUntilTheSilentMakeRoom) {
    int admitted = 0;
    for (std::uint8_t participant = 1; participant <= 20; ++participant) {
        for (std::uint32_t i = 0; i < 500; ++i) admitted += announce(participant, i);
    }
    EXPECT_EQ(admitted, rtps::EndpointLimits::most);
    now += 16 * second;
    EXPECT_TRUE(announce(30, 1));
}

TEST_F(EndpointsTest, AnEndpointOfAForeignTopicIsAGapToFastDds) {
    const auto left = [&](Datagram datagram) {
        datagram.resize(filter.admit(datagram, address, now).left);
        return datagram;
    };
    for (const char* topic : {"rt/chatter", "cortex", "cortexes/1", ""}) {
        const Datagram foreign = data(++number, ofWriters, 4, endpoint(1, 7, topic));
        const Datagram next = heartbeat(1, number, static_cast<std::uint32_t>(number), ofWriters);
        EXPECT_EQ(left(header() + foreign + next),
                  header() + gap(number, number + 1, 0, 0, ofWriters) + next)
            << topic;
    }
    const Datagram last = data(++number, ofReaders, 4, endpoint(1, 7, "rt/chatter"));
    EXPECT_EQ(left(header() + last), header() + gap(number, number + 1, 0, 0, ofReaders));
    const Datagram ours = data(++number, ofWriters, 4, endpoint(1, 7, "cortex/presence"));
    EXPECT_EQ(left(header() + ours), header() + ours);
}

TEST_F(EndpointsTest, EndpointsOfForeignTopicsTakeNoRoom) {
    for (std::uint8_t participant = 1; participant <= 40; ++participant) {
        for (std::uint32_t i = 0; i < 500; ++i) {
            const Datagram foreign = endpoint(participant, i, "rt/" + std::to_string(i));
            ASSERT_TRUE(passes(participant, i % 2 ? ofWriters : ofReaders, 4, foreign)) << i;
        }
    }
    for (std::uint32_t i = 0; i < most; ++i) EXPECT_TRUE(announce(50, i)) << i;
    EXPECT_TRUE(announce(51, 1));
    EXPECT_EQ(filter.dropped(), 0U);
}

TEST_F(EndpointsTest, AnAnnouncementNamesOneEndpointOfAnother) {
    const Datagram front{0, 3, 0, 0};
    EXPECT_FALSE(passes(1, ofReaders, 4, front + endOfList));
    EXPECT_FALSE(passes(1, ofReaders, 4,
                        front + guidParameter(0x5a, 1, 7) + guidParameter(0x70, 1, 8) + endOfList));
    Datagram ours = guidParameter(0x5a, 0, 7);
    std::fill_n(ours.begin() + 4, 3, std::uint8_t{9});
    EXPECT_FALSE(passes(1, ofReaders, 4, front + ours + endOfList));
    EXPECT_EQ(filter.dropped(Refusal::Parameters), 3U);
}

// --- what is sent -------------------------------------------------------------------------------

TEST(PiecesTest, ALongDatagramIsCutBetweenItsSubmessages) {
    const Datagram to = submessage(0x0e, 0, Datagram(12, 3)),
                   time = submessage(0x09, 0, Datagram(8));
    const auto sample = [](int number, std::size_t size = 600) {
        return data(number, anyWriter, 4, Datagram(size));
    };
    Datagram all = header() + to + time + sample(1) + time + sample(2) + gap(3, 5) + time +
                   sample(5) + heartbeat(1, 5);
    EXPECT_EQ(rtps::piecesOf(all),
              (std::vector{header() + to + time + sample(1) + time + sample(2),
                           header() + to + time + gap(3, 5) + time + sample(5) + heartbeat(1, 5)}));
    all = header() + sample(1, 3'000) + heartbeat(1, 1);
    EXPECT_EQ(rtps::piecesOf(all),
              (std::vector{header() + sample(1, 3'000), header() + heartbeat(1, 1)}));
}

TEST(PiecesTest, KnowsWhatIsSaidOfEndpoints) {
    const auto is = [](Datagram datagram) { return rtps::isAboutEndpoints(datagram); };
    EXPECT_TRUE(is(header() + data(1) + data(1, ofWriters)));
    EXPECT_TRUE(is(header() + heartbeat(1, 2, 1, ofReaders)));
    EXPECT_TRUE(is(header() + ackNack(1, 0, 0, ofWriters)));
    EXPECT_FALSE(is(header() + data(1) + heartbeat(1, 2) + ackNack(1)));
    EXPECT_FALSE(is(header() + announcement(endOfList)));
    EXPECT_FALSE(is(header() + submessage(0x15, 0, Datagram(4))));
}

TEST(PiecesTest, ASampleThatIsCutArrivesAsItWas) {
    const Datagram to = submessage(0x0e, 0, Datagram(12, 9)),
                   time = submessage(0x09, 0, Datagram(8));
    Datagram payload(3'000);
    for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<std::uint8_t>(i / 7);
    const Datagram key = parameter(0x70, Datagram(16, 5)) + endOfList;
    Datagram all = header() + to + time + data(4, anyWriter, 6, key + payload) + heartbeat(1, 4);
    const auto pieces = rtps::piecesOf(all, anyWriter);
    ASSERT_EQ(pieces.size(), 3U);
    const Datagram last = heartbeat(1, 4);
    EXPECT_TRUE(std::equal(last.rbegin(), last.rend(), pieces.back().rbegin()));

    DatagramFilter filter{rtps::Prefix{9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9}};
    filter.allowFragments(guidOf(1, anyWriter), true, second);
    std::vector<rtps::Message> whole;
    for (Datagram piece : {pieces[2], pieces[0], pieces[0], pieces[1]}) {
        EXPECT_LE(piece.size(), rtps::onePacket);
        for (auto& each : filter.admit(piece, address, second).whole) whole.push_back(each);
    }
    ASSERT_EQ(whole.size(), 3U);
    // Header, time, and 36 bytes in front of the parameters.
    const auto contentOf = [&](const Datagram& message) {
        return Datagram{message.begin() + 20 + 12 + 36 + static_cast<std::ptrdiff_t>(key.size()),
                        message.end()};
    };
    EXPECT_EQ(contentOf(whole[1]) + contentOf(whole[2]) + contentOf(whole[0]), payload);
    EXPECT_EQ(rtps::piecesOf(all, 0x203).size(), 2U) << "of another writer";
}

// --- the statistics behind what is sent ----------------------------------------------------------

const Datagram statistics = submessage(0x80, 0, Datagram(56, 7));
const Datagram destination = submessage(0x0e, 0, Datagram(12, 3));
const Datagram timestamp = submessage(0x09, 0, Datagram(8));

// Fast DDS would take its end for statistics, wherever it is cut.
Datagram sampleOf80(int number, std::size_t size) {
    return data(number, anyWriter, 4, Datagram(size, 0x80));
}

// The transport of Fast DDS writes into the last 56 bytes where these are not its own.
testing::AssertionResult endWithStatistics(const std::vector<Datagram>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!std::equal(statistics.rbegin(), statistics.rend(), pieces[i].rbegin()))
            return testing::AssertionFailure() << "piece " << i << " of " << pieces.size();
    }
    return testing::AssertionSuccess();
}

// As every message of a handshake and every large block is.
TEST(PiecesTest, OneLargeSampleStaysWholeWithItsStatistics) {
    Datagram one = header() + timestamp + sampleOf80(1, 3'000) + statistics;
    EXPECT_TRUE(rtps::piecesOf(one).empty());
}

TEST(PiecesTest, EachPieceEndsWithTheStatisticsOfTheWhole) {
    Datagram three = header() + destination + timestamp + sampleOf80(1, 600) + timestamp +
                     sampleOf80(2, 600) + timestamp + sampleOf80(3, 600) + statistics;
    EXPECT_EQ(rtps::piecesOf(three),
              (std::vector{header() + destination + timestamp + sampleOf80(1, 600) + timestamp +
                               sampleOf80(2, 600) + statistics,
                           header() + destination + timestamp + timestamp + sampleOf80(3, 600) +
                               statistics}));
    Datagram two = header() + sampleOf80(1, 3'000) + heartbeat(1, 1) + statistics;
    EXPECT_EQ(rtps::piecesOf(two), (std::vector{header() + sampleOf80(1, 3'000) + statistics,
                                                header() + heartbeat(1, 1) + statistics}));
}

TEST(PiecesTest, EachFragmentEndsWithThemWithinOnePacket) {
    const Datagram key = parameter(0x70, Datagram(16, 5)) + endOfList;
    const auto keyed = [&](std::size_t size) {
        return data(1, anyWriter, 6, key + Datagram(size, 0x80));
    };
    for (const Datagram& last : {Datagram{}, heartbeat(1, 1)}) {
        Datagram all = header() + destination + timestamp + keyed(3'000) + last + statistics;
        const auto pieces = rtps::piecesOf(all, anyWriter);
        EXPECT_EQ(pieces.size(), 3U);
        EXPECT_TRUE(endWithStatistics(pieces));
        for (const Datagram& piece : pieces) EXPECT_LE(piece.size(), rtps::onePacket);
    }
    // 1,400 bytes, with 96 in front of the sample and 60 behind it; then one word more.
    const Datagram front = header() + destination + timestamp;
    constexpr std::size_t fits = rtps::onePacket - 20 - 16 - 12 - 24 - 24 - 60;
    Datagram full = front + keyed(fits) + statistics, over = front + keyed(fits + 4) + statistics;
    EXPECT_EQ(full.size(), rtps::onePacket);
    EXPECT_TRUE(rtps::piecesOf(full, anyWriter).empty());
    EXPECT_EQ(rtps::piecesOf(over, anyWriter).size(), 2U);
    EXPECT_TRUE(endWithStatistics(rtps::piecesOf(over, anyWriter)));
}

TEST(PiecesTest, AreFilledUpToTheStatistics) {
    const Datagram first = sampleOf80(1, 600);
    const std::size_t left = rtps::onePacket - (header() + first + statistics + data(2)).size();
    for (const std::size_t more : {0U, 4U}) {
        Datagram all = header() + first + sampleOf80(2, 8 + left + more) + first + statistics;
        const auto pieces = rtps::piecesOf(all);
        EXPECT_EQ(pieces.size(), more == 0 ? 2U : 3U);
        EXPECT_TRUE(endWithStatistics(pieces));
        for (const Datagram& piece : pieces) EXPECT_LE(piece.size(), rtps::onePacket);
    }
}

TEST(PiecesTest, BytesThatLookLikeStatisticsAreNone) {
    const Datagram otherSize = submessage(0x80, 0, Datagram(52, 7)),
                   otherKind = submessage(0x81, 0, Datagram(56, 7));
    for (const Datagram& end : {Datagram{}, otherSize, otherKind}) {
        Datagram two = header() + sampleOf80(1, 800) + sampleOf80(2, 800) + end;
        EXPECT_EQ(rtps::piecesOf(two), (std::vector{header() + sampleOf80(1, 800),
                                                    header() + sampleOf80(2, 800) + end}));
    }
}

TEST(PiecesTest, WhatWouldBeTakenForStatisticsGetsSome) {
    const auto ended = [](Datagram piece) {
        rtps::endWithStatistics(piece);
        return piece;
    };
    const Datagram none = submessage(0x80, 0, Datagram(56));
    const Datagram taken = header() + sampleOf80(1, 800);
    EXPECT_EQ(ended(taken), taken + none);
    const Datagram shortest = header() + Datagram{0x80, 1, 56, 0} + Datagram(56);
    for (const Datagram& as :
         {taken + statistics, taken + none, shortest, header() + data(1),
          header() + data(1, anyWriter, 4, Datagram(800, 0x7f)), header() + sampleOf80(1, 32)}) {
        EXPECT_EQ(ended(as), as) << as.size();
    }
}

TEST(PiecesTest, WhatIsShortOneOrSignedStaysAsItIs) {
    const Datagram time = submessage(0x09, 0, Datagram(8));
    const Datagram longOne = data(1, anyWriter, 4, Datagram(3'000));
    const Datagram postfix = submessage(0x34, 0, Datagram(20));
    Datagram brief = header() + data(1) + data(2), one = header() + time + longOne;
    Datagram isSigned = header() + submessage(0x33, 0, Datagram(20)) + longOne + longOne + postfix;
    Datagram counted = isSigned + statistics;
    Datagram lying = header() + longOne + longOne + Datagram{1, 1, 255, 255};
    EXPECT_TRUE(rtps::piecesOf(brief).empty());
    EXPECT_TRUE(rtps::piecesOf(one).empty());
    EXPECT_TRUE(rtps::piecesOf(isSigned).empty());
    EXPECT_TRUE(rtps::piecesOf(counted).empty());
    EXPECT_TRUE(rtps::piecesOf(lying).empty());
}

}  // namespace
}  // namespace cortex::comms::bounds
