// SPDX-License-Identifier: Apache-2.0
#include "comms/datagrams.hpp"
#include "rtps/datagram_filter.hpp"
#include "wire/presence_interval.hpp"

#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace datagrams;
using rtps::DatagramFilter;
using rtps::Refusal;

constexpr std::uint32_t ofThePeer = 0x0a000007;

Datagram locator(std::uint32_t where, std::uint32_t port = 7411, int id = 0x0032) {
    Datagram content;
    put(content, 1, 4);
    put(content, port, 4);
    content.resize(20);
    putEntity(content, where);
    return parameter(id, content);
}

constexpr std::uint32_t group = 0xefff0001;

// A participant of `prefix`, from an address, and what it says of itself.
struct Saying {
    Datagram parameters;
    std::uint32_t from = ofThePeer;
    std::uint8_t prefix = 1;
    std::uint8_t sender = 1;
};

struct PlacesTest : testing::Test {
    Refusal said(const Saying& saying) {
        now += 100'000'000;
        Datagram datagram =
            header(saying.sender) +
            data(1, discoveryWriter, 4,
                 Datagram{0, 3, 0, 0} + guidOf(saying.prefix) + saying.parameters + endOfList);
        const auto dropped = [&] { return filter.dropped(Refusal::Places); };
        const std::uint64_t before = dropped();
        if (filter.admit(datagram, saying.from, now).left > 0) return Refusal::None;
        return dropped() > before ? Refusal::Places : Refusal::Content;
    }

    rtps::Prefix us{9, 9, 9};
    DatagramFilter filter{us};
    std::int64_t now = 1'000'000'000;
    const Datagram here = locator(ofThePeer);
};

TEST_F(PlacesTest, AParticipantKeepsTheAddressesThatItAnnouncedFirst) {
    ASSERT_EQ(said({here}), Refusal::None);
    EXPECT_EQ(said({here}), Refusal::None);
    EXPECT_EQ(said({locator(0x7f000063)}), Refusal::Places);
    EXPECT_EQ(said({locator(ofThePeer, 7413)}), Refusal::Places);
    EXPECT_EQ(said({locator(0x0a000063) + here}), Refusal::Places);
    EXPECT_EQ(said({locator(0x0a000063, 7411, 0x0031) + here}), Refusal::Places);
    EXPECT_EQ(said({{}}), Refusal::Places);
    EXPECT_EQ(said({here + locator(ofThePeer, 7413)}), Refusal::None) << "one more behind it";
    EXPECT_EQ(said({here}), Refusal::None);
    EXPECT_EQ(filter.dropped(Refusal::Places), 5U);
    EXPECT_NE(filter.summary().find("other addresses than at first"), std::string::npos);
}

TEST_F(PlacesTest, AParticipantMayNameTheGroupOfItsDomainLaterAndNoOther) {
    ASSERT_EQ(said({here}), Refusal::None);
    EXPECT_EQ(said({locator(group, 7400, 0x0033) + here}), Refusal::None);
    EXPECT_EQ(said({here}), Refusal::None);
    EXPECT_EQ(said({locator(group, 7401, 0x0033) + here}), Refusal::Places);
    EXPECT_EQ(said({locator(group + 1, 7400, 0x0033) + here}), Refusal::Places);
    EXPECT_EQ(said({locator(0x0a000063, 7400, 0x0048) + here}), Refusal::Places);
}

TEST_F(PlacesTest, OnlyAParticipantItselfAnnouncesItFromWhereItIs) {
    EXPECT_EQ(said({.parameters = here, .prefix = 2}), Refusal::Places) << "another one";
    ASSERT_EQ(said({here}), Refusal::None);
    EXPECT_EQ(said({here, 0x0a000008}), Refusal::Places);
    EXPECT_EQ(said({here, 0x7f000001}), Refusal::None) << "from this host";
    EXPECT_EQ(said({.parameters = here + locator(0x0a000009),
                    .from = 0xc0000201,
                    .prefix = 3,
                    .sender = 3}),
              Refusal::None)
        << "behind another address, from the first time on";
    EXPECT_EQ(said({.parameters = here + locator(0x0a000009),
                    .from = 0xc0000201,
                    .prefix = 3,
                    .sender = 3}),
              Refusal::None);
}

TEST_F(PlacesTest, AnotherParticipantMayHaveItsIdAfterALease) {
    ASSERT_EQ(said({here}), Refusal::None);
    now += leaseOfParticipant - 5'000'000'000;
    EXPECT_EQ(said({locator(0x0a000063), 0x0a000063}), Refusal::Places) << "also after a goodbye";
    now += 6'000'000'000;
    EXPECT_EQ(said({locator(0x0a000063), 0x0a000063}), Refusal::None);
    EXPECT_EQ(said({here}), Refusal::Places);
}

TEST_F(PlacesTest, ADiscoveryServerPassesOnWhatParticipantsSay) {
    DatagramFilter relayed{us, 0, true};
    const auto passes = [&](const Datagram& parameters) {
        now += 100'000'000;
        Datagram datagram =
            header(7) +
            data(1, discoveryWriter, 4, Datagram{0, 3, 0, 0} + guidOf(2) + parameters + endOfList);
        return relayed.admit(datagram, 0x0a0000ff, now).left > 0;
    };
    EXPECT_TRUE(passes(here));
    EXPECT_FALSE(passes(locator(0x0a000063)));
    EXPECT_TRUE(passes(here));
}

}  // namespace
}  // namespace cortex::comms
