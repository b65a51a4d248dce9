// SPDX-License-Identifier: Apache-2.0
#include "rtps/datagram_filter.hpp"

#include "comms/datagrams.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace datagrams;
using rtps::DatagramFilter;
using rtps::Refusal;

constexpr std::uint32_t address = 0x0a000007;

struct FilterTest : testing::Test {
    // Why a datagram is dropped.
    Refusal refusal(Datagram datagram) {
        if (filter.admit(datagram, address, now).left > 0) return Refusal::None;
        for (std::size_t i = 1; i < rtps::refusals; ++i) {
            const auto reason = static_cast<Refusal>(i);
            if (filter.dropped(reason) > std::exchange(before[i], filter.dropped(reason)))
                return reason;
        }
        return Refusal::None;
    }
    // What is left of one.
    Datagram admitted(Datagram datagram) {
        datagram.resize(filter.admit(datagram, address, now).left);
        return datagram;
    }

    rtps::Prefix us{9, 9, 9};
    rtps::WriterGuid writer{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 1, 3};
    DatagramFilter filter{us};
    std::array<std::uint64_t, rtps::refusals> before{};
    std::int64_t now = 1'000'000'000;
};

TEST_F(FilterTest, PassesWhatIsWellFormedAsItIs) {
    const Datagram timestamp = submessage(0x09, 0, Datagram(8)), none = submessage(0x09, 2, {});
    const Datagram destination = submessage(0x0e, 0, Datagram(12));
    const Datagram datagram = header() + destination + timestamp + data(1) + none + data(2) +
                              heartbeat(1, 2) + gap(3, 4, 33, 2) + ackNack(0) +
                              submessage(0x01, 0, {});
    EXPECT_EQ(admitted(datagram), datagram);
}

TEST_F(FilterTest, DropsWhatDoesNotAddUp) {
    Datagram otherVersion = header() + data(1);
    otherVersion[4] = 3;
    EXPECT_EQ(refusal(otherVersion), Refusal::Framing);
    EXPECT_EQ(refusal({}), Refusal::Framing);
    EXPECT_EQ(refusal(Datagram(19, 'R')), Refusal::Framing);
    const Datagram good = header() + data(1) + data(2);
    for (std::size_t size = 21; size < good.size(); ++size) {
        const Datagram cut{good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)};
        if (cut == header() + data(1)) continue;
        EXPECT_NE(refusal(cut), Refusal::None) << size;
    }
    Datagram odd = submessage(0x09, 2, {}) + data(1);
    odd[2] = 2;
    EXPECT_EQ(refusal(header() + odd), Refusal::Framing);
}

TEST_F(FilterTest, TakesStatisticsOutWhereverTheyStand) {
    const Datagram statistics = submessage(0x80, 0, Datagram(56));
    const Datagram plain = header() + data(1) + data(2);
    EXPECT_EQ(admitted(header() + data(1) + data(2) + statistics), plain);
    EXPECT_EQ(admitted(header() + data(1) + statistics + data(2)), plain);
    EXPECT_EQ(admitted(header() + statistics + data(1) + statistics + data(2)), plain);
}

TEST_F(FilterTest, DropsContentOutOfBounds) {
    const std::vector<std::pair<const char*, Datagram>> bad{
        {"short data", submessage(0x15, 4, Datagram(16))},
        {"number 0", data(0)},
        {"negative number", data(-1)},
        {"data and key", data(1, anyWriter, 12)},
        {"no payload", data(1, anyWriter, 4, {})},
        {"heartbeat from 0", heartbeat(0, 5)},
        {"heartbeat that ends before it begins", heartbeat(5, 3)},
        {"gap from 0", gap(0, 3)},
        {"gap that ends before it begins", gap(4, 3)},
        {"gap with too many bits", gap(1, 2, 257, 9)},
        {"gap with bits that are not there", gap(1, 2, 64, 1)},
        {"acknowledgement with bits that are not there", ackNack(1, 64, 1)},
        {"negative acknowledgement", ackNack(-1)},
        {"short destination", submessage(0x0e, 0, Datagram(8))},
        {"short source", submessage(0x0c, 0, Datagram(16))},
        {"short time", submessage(0x09, 0, Datagram(4))},
        {"fragments of no size", dataFragment({.size = 0})},
        {"no fragment", dataFragment({.count = 0})},
        {"fragment 0", dataFragment({.first = 0})},
        {"fragment behind the sample", dataFragment({.first = 3})},
        {"more fragments than the sample", dataFragment({.count = 3, .rest = Datagram(24)})},
        {"fragment that is not there", dataFragment({.rest = Datagram(4)})},
    };
    for (const auto& [what, submessages] : bad) {
        EXPECT_EQ(refusal(header() + submessages), Refusal::Content) << what;
        // Nothing of such a datagram counts.
        EXPECT_EQ(refusal(header() + data(1) + submessages), Refusal::Content) << what;
    }
    Datagram farParameters = data(1, anyWriter, 6, endOfList);
    farParameters[6] = 200;
    EXPECT_EQ(refusal(header() + farParameters), Refusal::Content);
}

TEST_F(FilterTest, DropsListsOfParametersThatDoNotEndOrCountTooMuch) {
    const auto inFront = [&](const Datagram& list) {
        return refusal(header() + data(1, anyWriter, 2, list));
    };
    EXPECT_EQ(inFront(parameter(0x70, Datagram(16)) + endOfList), Refusal::None);
    EXPECT_EQ(inFront(parameter(0x70, Datagram(16))), Refusal::Parameters);
    EXPECT_EQ(inFront(parameter(0x70, Datagram(12)) + endOfList), Refusal::Parameters);
    EXPECT_EQ(inFront(Datagram{0x70, 0, 200, 0} + endOfList), Refusal::Parameters);
    EXPECT_EQ(inFront(Datagram{0x70, 0, 2, 0, 0, 0} + endOfList), Refusal::Parameters);

    const auto said = [&](const Datagram& list) { return refusal(header() + announcement(list)); };
    const Datagram many{0, 0, 0, 16}, two{2, 0, 0, 0};
    EXPECT_EQ(said(endOfList), Refusal::None);
    EXPECT_EQ(said(parameter(0x05, text("topic")) + endOfList), Refusal::None);
    EXPECT_EQ(said(parameter(0x05, many + text("topic")) + endOfList), Refusal::Parameters);
    EXPECT_EQ(
        said(parameter(0x59, two + text("a") + Datagram(2) + text("b") + Datagram(2)) + endOfList),
        Refusal::Parameters);
    EXPECT_EQ(said(parameter(0x59, many + text("abc")) + endOfList), Refusal::Parameters);
    EXPECT_EQ(said(parameter(0x2c, many) + endOfList), Refusal::Parameters);
    EXPECT_EQ(said(parameter(0x29, many) + endOfList), Refusal::Parameters);
    EXPECT_EQ(said(parameter(0x73, many) + endOfList), Refusal::Parameters);
    EXPECT_EQ(said(parameter(0x1001, text("token") + Datagram(2) + many) + endOfList),
              Refusal::Parameters);
    const Datagram forEver{255, 255, 255, 127, 255, 255, 255, 255};
    EXPECT_EQ(said(parameter(0x02, forEver) + endOfList), Refusal::Parameters);
    EXPECT_EQ(said(parameter(0x02, Datagram{10, 0, 0, 0, 0, 0, 0, 0}) + endOfList), Refusal::None);
}

TEST_F(FilterTest, DropsMessagesOfAHandshakeThatCountTooMuch) {
    const auto said = [&](const Datagram& tokens) {
        return refusal(header() + data(1, 0x000201c3, 4,
                                       Datagram{0, 1, 0, 0} + Datagram(96) + text("auth") +
                                           Datagram(3) + tokens));
    };
    const Datagram none{0, 0, 0, 0}, one{1, 0, 0, 0}, many{0, 0, 0, 16};
    const Datagram name = text("tok");
    EXPECT_EQ(said(none), Refusal::None);
    EXPECT_EQ(said(one + name + none + none), Refusal::None);
    EXPECT_EQ(said(one + name + one + name + name + one + name + name), Refusal::None);
    EXPECT_EQ(said(many), Refusal::Parameters);
    EXPECT_EQ(said(one + name + many), Refusal::Parameters);
    EXPECT_EQ(said(one + name + none + many), Refusal::Parameters);
    EXPECT_EQ(said(one + name + none + one + name + many), Refusal::Parameters);
    EXPECT_EQ(refusal(header() + data(1, 0x000201c3)), Refusal::Parameters);
}

TEST_F(FilterTest, HidesDescriptionsOfTypesAndKeysOfFragments) {
    const auto hidden = [](Datagram datagram, std::uint8_t id) {
        const auto at = std::ranges::search(datagram, Datagram{id, 0, 16, 0}).begin();
        *at = 0;
        return datagram;
    };
    for (const int id : {0x69, 0x72, 0x75}) {
        const Datagram datagram = header() + announcement(parameter(id, Datagram(16)) + endOfList);
        EXPECT_EQ(admitted(datagram), hidden(datagram, static_cast<std::uint8_t>(id)));
    }
    filter.allowFragments(writer, true, now);
    Datagram fragment =
        header() + dataFragment({.sample = 8,
                                 .flags = 2,
                                 .rest = parameter(0x70, Datagram(16)) + endOfList + Datagram(8)});
    const Datagram expected = hidden(fragment, 0x70);
    EXPECT_EQ(filter.admit(fragment, address, now).whole, std::vector<Datagram>{expected});
}

TEST_F(FilterTest, AdmitsFragmentsOnlyOfWritersThatMayNeedThem) {
    EXPECT_EQ(refusal(header() + dataFragment({})), Refusal::Fragment);
    filter.allowFragments(writer, true, now);
    EXPECT_EQ(refusal(header() + dataFragment({})), Refusal::None);
    EXPECT_EQ(refusal(header() + dataFragment({.first = 2})), Refusal::None);
    EXPECT_EQ(refusal(header() + dataFragment({.sample = (16u << 20) + 1})), Refusal::Fragment);
}

TEST_F(FilterTest, OneNumberTooHighHasNoEffect) {
    ASSERT_EQ(refusal(header() + data(100)), Refusal::None);
    std::int64_t next = 100;
    for (const Datagram& forged : {data(1LL << 40), data(1'000), heartbeat(900, 1'001),
                                   gap(101, 1'002), data(1'003), dataFragment({.number = 2'000})}) {
        filter.allowFragments(writer, true, now);
        EXPECT_EQ(refusal(header() + forged), Refusal::Number);
        EXPECT_EQ(refusal(header() + data(++next)), Refusal::None);
    }
    EXPECT_EQ(refusal(header() + data(next + 4)), Refusal::None);
}

TEST_F(FilterTest, AWriterOfWhichMuchWasLostGoesOn) {
    ASSERT_EQ(refusal(header() + data(100)), Refusal::None);
    EXPECT_EQ(refusal(header() + data(900)), Refusal::Number);
    EXPECT_EQ(refusal(header() + data(901)), Refusal::None);
    EXPECT_EQ(refusal(header() + data(902)), Refusal::None);
    // Its heartbeats say the same number again and again.
    EXPECT_EQ(refusal(header() + heartbeat(1, 2'000, 7)), Refusal::Number);
    EXPECT_EQ(refusal(header() + heartbeat(1, 2'000, 7)), Refusal::Number);
    EXPECT_EQ(refusal(header() + heartbeat(1, 2'000, 8)), Refusal::None);
    // Samples that are sent again are far below.
    EXPECT_EQ(refusal(header() + data(101)), Refusal::None);
    // A long silence is many numbers of a quick writer, but not 10 million.
    now += 50'000'000'000;
    EXPECT_EQ(refusal(header() + data(60'000)), Refusal::Number);
    EXPECT_EQ(refusal(header() + data(60'001)), Refusal::None);
    EXPECT_EQ(refusal(header() + data(10'060'000)), Refusal::Number);
    EXPECT_EQ(refusal(header() + data(10'060'001)), Refusal::Number);
}

// A participant that announced itself often while it was not heard, and now says the last one
// again.
TEST_F(FilterTest, AnAnnouncementThatIsSaidAgainIsTakenAfterALongLoss) {
    const auto announces = [](std::int64_t number) {
        return header() +
               data(number, discoveryWriter, 4, Datagram{0, 3, 0, 0} + guidOf() + endOfList);
    };
    ASSERT_EQ(refusal(announces(1)), Refusal::None);
    now += 50'000'000'000;
    EXPECT_EQ(refusal(announces(600)), Refusal::Number);
    EXPECT_EQ(refusal(announces(600)), Refusal::Number) << "at once: one datagram, twice";
    now += 3'000'000'000;
    EXPECT_EQ(refusal(announces(600)), Refusal::None);
}

// As where a program of another domain has taken one of our ports.
TEST_F(FilterTest, AParticipantThatNamesAnotherDomainIsDropped) {
    DatagramFilter ofSeven{us, 7};
    const auto passes = [&](const Datagram& parameters) {
        Datagram datagram = header() + announcement(parameters + endOfList);
        return ofSeven.admit(datagram, address, now).left > 0;
    };
    EXPECT_TRUE(passes(parameter(0x000f, {7, 0, 0, 0})));
    EXPECT_TRUE(passes({})) << "Fast DDS 2.9 names none";
    EXPECT_EQ(ofSeven.dropped(), 0U);
    EXPECT_FALSE(passes(parameter(0x000f, {8, 0, 0, 0})));
    EXPECT_EQ(ofSeven.dropped(Refusal::Domain), 1U);
}

// 1,000 numbers a second, of which 20 % are lost and the others take up to 20 ms.
TEST_F(FilterTest, FollowsAWriterWhoseDatagramsAreLostAndOvertakeEachOther) {
    std::mt19937 chance{7};
    std::vector<std::pair<std::int64_t, std::int64_t>> arrivals;  // time and number
    for (std::int64_t number = 1; number <= 5'000; ++number) {
        if (chance() % 5 == 0) continue;
        const auto late = static_cast<std::int64_t>(chance() % 20'000'000);
        arrivals.emplace_back(now + number * 1'000'000 + late, number);
    }
    std::ranges::sort(arrivals);
    int dropped = 0, droppedAtFirst = 0;
    for (const auto& [time, number] : arrivals) {
        now = time;
        if (refusal(header() + data(number)) == Refusal::None) continue;
        ++(number <= 100 ? droppedAtFirst : dropped);
    }
    EXPECT_EQ(dropped, 0);
    EXPECT_LE(droppedAtFirst, 60);
    // One that is forged has no effect for longer than the window.
    EXPECT_EQ(refusal(header() + data(6'000)), Refusal::Number);
}

TEST_F(FilterTest, AWriterThatIsSlowHasASmallWindow) {
    for (int i = 1; i <= 20; ++i) {
        now += 100'000'000;
        ASSERT_EQ(refusal(header() + data(i)), Refusal::None);
    }
    EXPECT_EQ(refusal(header() + data(26)), Refusal::Number);
    EXPECT_EQ(refusal(header() + data(24)), Refusal::None);
}

// What a new reader gets of a writer that took samples back, and again when it was lost.
TEST_F(FilterTest, AGapAndWhatFollowsItPassTogether) {
    ASSERT_EQ(refusal(header() + data(3)), Refusal::None);
    EXPECT_EQ(refusal(header() + gap(4, 10) + data(10)), Refusal::None);
    EXPECT_EQ(refusal(header() + gap(11, 300)), Refusal::Number);
    EXPECT_EQ(refusal(header() + gap(11, 300)), Refusal::Number) << "at once: one datagram, twice";
    now += 100'000'000;
    EXPECT_EQ(refusal(header() + gap(11, 300)), Refusal::None);
    EXPECT_EQ(refusal(header() + gap(300, 600) + data(600, 0x203)), Refusal::Number)
        << "another writer";
    EXPECT_EQ(refusal(header() + gap(300, 900) + data(1'000)), Refusal::Number);
    EXPECT_EQ(refusal(header() + data(300)), Refusal::None);
}

TEST_F(FilterTest, AWriterThatWasForgedBeforeItWasMetIsBelieved) {
    EXPECT_EQ(refusal(header() + data((1LL << 40) + 1)), Refusal::Number);
    ASSERT_EQ(refusal(header() + data(1LL << 40)), Refusal::None);
    for (int i = 1; i <= 32; ++i) EXPECT_EQ(refusal(header() + data(i)), Refusal::None) << i;
    EXPECT_EQ(refusal(header() + data(1LL << 39)), Refusal::Number);
}

TEST_F(FilterTest, AnotherWriterHasNumbersOfItsOwn) {
    ASSERT_EQ(refusal(header(1) + data(100)), Refusal::None);
    EXPECT_EQ(refusal(header(2) + data(5'000)), Refusal::None);
    EXPECT_EQ(refusal(header(1) + data(5'000, 0x203)), Refusal::None);
    Datagram source(8);
    source.resize(20, 2);
    EXPECT_EQ(refusal(header(1) + submessage(0x0c, 0, source) + data(5'001)), Refusal::None);
}

TEST_F(FilterTest, GreatStepsOfNumbersBecomeSmaller) {
    constexpr std::int64_t step = 1 << 24;
    EXPECT_EQ(admitted(header() + heartbeat(10 * step, 10 * step)),
              header() + heartbeat(step, 10 * step));
    EXPECT_EQ(admitted(header() + heartbeat(10 * step, 10 * step, 2)),
              header() + heartbeat(2 * step, 10 * step, 2));
    EXPECT_EQ(admitted(header() + heartbeat(1, 0, 3)), header() + heartbeat(1, 0, 3));
    EXPECT_EQ(admitted(header() + gap(1, 10 * step, 32, 1)), header() + gap(1, 4097, 0, 1));
}

TEST_F(FilterTest, NobodyAcknowledgesMoreThanWasWritten) {
    EXPECT_EQ(refusal(header() + ackNack(1'000)), Refusal::None);  // nothing is known of it
    Datagram ours = header() + data(41) + heartbeat(1, 42);
    filter.noteSent(ours, now);
    EXPECT_EQ(refusal(header() + ackNack(43)), Refusal::None);
    EXPECT_EQ(refusal(header() + ackNack(44)), Refusal::Number);
    // A destination that is not this participant.
    const Datagram other = submessage(0x0e, 0, Datagram(12, 3));
    EXPECT_EQ(refusal(header() + other + ackNack(44)), Refusal::None);
}

// What a participant sends that lost us, met us anew and got a heartbeat before it asked for all.
TEST_F(FilterTest, WhoAsksAgainForOurEndpointsAsksForAllOfThem) {
    constexpr int isFinal = 2;
    for (const std::uint32_t each : {rtps::announcesWriters, rtps::announcesReaders}) {
        const auto asks = [&](std::int64_t from, std::uint32_t bits, std::uint32_t count) {
            return header() + ackNack(from, bits, (bits + 31) / 32, each, count, isFinal);
        };
        Datagram all = header() + ackNack(0, 0, 1, each, 9);
        std::ranges::copy(Datagram{9, 0, 0, 0}, all.end() - 8);  // the count, then what is left
        EXPECT_EQ(admitted(asks(0, 0, 4)), asks(0, 0, 4));
        EXPECT_EQ(admitted(asks(12, 0, 5)), asks(12, 0, 5)) << "it has all of them";
        EXPECT_EQ(admitted(asks(1, 11, 4)), asks(1, 11, 4)) << "sent earlier";
        EXPECT_EQ(admitted(asks(1, 11, 9)), all);
        EXPECT_EQ(admitted(asks(1, 11, 10)), asks(1, 11, 10)) << "it is being told";
        EXPECT_EQ(admitted(asks(12, 0, 11)), asks(12, 0, 11));
    }
    const auto ofUser = [&](std::int64_t from, std::uint32_t count) {
        return header() + ackNack(from, 0, 0, anyWriter, count);
    };
    EXPECT_EQ(admitted(ofUser(12, 1)), ofUser(12, 1));
    EXPECT_EQ(admitted(ofUser(1, 2)), ofUser(1, 2)) << "values are not told again";
}

// Fast DDS must not meet it while it drops it.
TEST_F(FilterTest, WhoWasSilentForALeaseIsHeardASecondAfterItsEnd) {
    const auto isHeard = [&] { return !admitted(header() + data(1)).empty(); };
    const std::int64_t tenth = 100'000'000, lease = leaseOfParticipant;
    EXPECT_TRUE(isHeard());
    now += lease - 11 * tenth;
    EXPECT_TRUE(isHeard());
    const std::int64_t end = now + lease;
    for (now = end - 9 * tenth; now < end + 10 * tenth; now += tenth) EXPECT_FALSE(isHeard());
    EXPECT_TRUE(isHeard());
    now += 100 * lease;
    const std::int64_t back = now;
    for (; now < back + 10 * tenth; now += tenth) EXPECT_FALSE(isHeard());
    EXPECT_TRUE(isHeard());
    EXPECT_EQ(filter.dropped(), 0U) << "a network that works";
}

TEST_F(FilterTest, WhatItSaidItselfOfItsEndpointsComesBackAndIsNotCounted) {
    Datagram front = header();
    std::ranges::copy(us, front.begin() + 8);
    const Datagram endpoint = Datagram(us.begin(), us.end()) + Datagram{0, 0, 1, 3};
    const Datagram announced = data(1, rtps::announcesWriters, 4,
                                    Datagram{0, 3, 0, 0} + parameter(0x5a, endpoint) + endOfList);
    Datagram said = front + announced;
    EXPECT_EQ(refusal(said), Refusal::Parameters) << "it has not said that yet";

    filter.noteSent(said, now);
    EXPECT_EQ(filter.admit(said, address, now).left, 0U) << "Fast DDS would keep it for ever";
    EXPECT_EQ(filter.dropped(), 1U) << "only what it has not said";
    EXPECT_EQ(refusal(header() + announced), Refusal::Parameters) << "another says it";
}

TEST_F(FilterTest, WhatIsSignedAddsUpAndIsNotChanged) {
    const Datagram prefix = submessage(0x33, 0, Datagram(20)),
                   body = submessage(0x30, 0, Datagram(8));
    const Datagram postfix = submessage(0x34, 0, Datagram(20));
    const Datagram encrypted =
        submessage(0x31, 0, Datagram(20)) + body + submessage(0x32, 0, Datagram(20));
    const Datagram statistics = submessage(0x80, 0, Datagram(56));
    const Datagram good =
        header() + prefix + data(1) + heartbeat(1LL << 40, 1LL << 40) + encrypted + postfix;
    EXPECT_EQ(admitted(good), good);
    EXPECT_EQ(admitted(good + statistics), good);
    EXPECT_EQ(admitted(header() + encrypted), header() + encrypted);

    EXPECT_EQ(refusal(header() + prefix + data(1)), Refusal::Framing);
    EXPECT_EQ(refusal(header() + prefix + statistics + postfix), Refusal::Framing);
    EXPECT_EQ(refusal(header() + data(1) + prefix + postfix), Refusal::Framing);
    EXPECT_EQ(refusal(header() + data(1) + postfix), Refusal::Framing);
    EXPECT_EQ(refusal(good + data(1)), Refusal::Framing);
    EXPECT_EQ(refusal(header() + submessage(0x31, 0, Datagram(20)) + body), Refusal::Framing);
    EXPECT_EQ(refusal(header() + submessage(0x31, 0, Datagram(20)) + statistics +
                      submessage(0x32, 0, Datagram(20))),
              Refusal::Framing);
    EXPECT_EQ(refusal(header() + body), Refusal::Framing);
    EXPECT_EQ(refusal(header() + submessage(0x33, 0, Datagram(16)) + postfix), Refusal::Content);
    Datagram longBody(8);
    longBody[3] = 5;  // its length, in the byte order of the network
    EXPECT_EQ(refusal(header() + prefix + submessage(0x30, 0, longBody) + postfix),
              Refusal::Content);
    Datagram manyReceivers(20);
    manyReceivers[19] = 1;
    EXPECT_EQ(refusal(header() + prefix + submessage(0x34, 0, manyReceivers)), Refusal::Content);

    // 400 submessages that say to be 65,535 bytes long.
    Datagram attack = header() + prefix;
    for (int i = 0; i < 400; ++i) attack = attack + Datagram{1, 1, 255, 255};
    EXPECT_EQ(refusal(attack + postfix), Refusal::Framing);
}

TEST_F(FilterTest, BoundsTheParticipantsOfAnAddressAndRecovers) {
    const auto from = [&](int participant, std::uint32_t host) {
        Datagram datagram = header() + data(1);
        datagram[8] = static_cast<std::uint8_t>(participant);
        datagram[9] = static_cast<std::uint8_t>(participant >> 8);
        return filter.admit(datagram, host, now).left > 0;
    };
    int admitted = 0;
    for (int i = 0; i < 2'000; ++i) admitted += from(i, 1);
    EXPECT_EQ(admitted, 400);
    EXPECT_TRUE(from(3, 1));
    EXPECT_FALSE(from(5'000, 1));
    EXPECT_TRUE(from(5'000, 2));
    for (int i = 0; i < 4'000; ++i) admitted += from(10'000 + i, 3 + static_cast<std::uint32_t>(i));
    EXPECT_LE(admitted, 1'024);
    EXPECT_GT(admitted, 900);
    EXPECT_FALSE(from(6'000, 9'000));
    now += 15'000'000'001;
    EXPECT_TRUE(from(6'000, 9'000));
}

TEST_F(FilterTest, TellsEachReasonOnceASecondWithItsCount) {
    EXPECT_TRUE(filter.takeReports(now).empty());
    EXPECT_EQ(filter.summary(), "");
    for (int i = 0; i < 3; ++i) EXPECT_EQ(refusal({}), Refusal::Framing);
    using Texts = std::vector<std::string>;
    EXPECT_EQ(filter.takeReports(now),
              Texts{"3 datagrams were dropped: they are no messages of RTPS; the last came from "
                    "10.0.0.7"});
    EXPECT_EQ(refusal({}), Refusal::Framing);
    EXPECT_TRUE(filter.takeReports(now + 999'999'999).empty());
    EXPECT_EQ(filter.takeReports(now + 1'000'000'000).size(), 1U);
    EXPECT_EQ(filter.summary(), "4 as they are no messages of RTPS");
    EXPECT_EQ(filter.dropped(), 4U);
}

}  // namespace
}  // namespace cortex::comms
