// SPDX-License-Identifier: Apache-2.0
#include "dds/repeats.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <fastrtps/utils/IPLocator.h>
#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

using namespace std::chrono_literals;
using eprosima::fastrtps::rtps::IPLocator;
using Octets = std::vector<std::uint8_t>;

constexpr std::uint32_t participants = 0x000100c2, publications = 0x000003c2;
constexpr std::uint32_t subscriptions = 0x000004c2;
constexpr std::uint32_t ofUser = 0x00000202, theirReader = 0x00000307, theirOther = 0x00000407;

Repeats::Prefix prefix(std::uint8_t last) {
    Repeats::Prefix made;
    made.value[11] = last;
    return made;
}

// Of discovery the reader is named as its writer.
std::uint32_t readerOf(std::uint32_t writer) { return writer == ofUser ? theirReader : writer + 5; }

Repeats::Entity entity(std::uint32_t number) {
    Repeats::Entity made;
    for (int i = 0; i < 4; ++i) made.value[i] = static_cast<std::uint8_t>(number >> 8 * (3 - i));
    return made;
}

Repeats::Locator at(const char* ip, std::uint32_t port) {
    Repeats::Locator made;
    IPLocator::setIPv4(made, ip);
    made.port = port;
    return made;
}

// A datagram of RTPS, in the order of octets that is asked for.
class Datagram {
public:
    explicit Datagram(std::uint8_t from, bool little = true) : little_{little} {
        octets_ = {'R', 'T', 'P', 'S', 2, 3, 1, 15};
        append(prefix(from));
    }
    Datagram to(std::uint8_t who) const {
        Datagram made = *this;
        made.begin(0x0e, 12);
        made.append(prefix(who));
        return made;
    }
    Datagram data(std::uint32_t writer, std::uint8_t content) const {
        Datagram made = *this;
        made.begin(0x15, 20);
        made.number(0);
        made.append(0);
        made.append(writer);
        made.number(0);
        made.number(content);
        return made;
    }
    Datagram heartbeat(std::uint32_t writer, std::uint32_t last) const {
        Datagram made = *this;
        made.begin(0x07, 28);
        made.append(0);
        made.append(writer);
        for (const std::uint32_t each : {0U, 1U, 0U, last, 1U}) made.number(each);
        return made;
    }
    Datagram acknowledged(std::uint32_t writer, std::uint32_t next, std::uint32_t lacking) const {
        return acknowledgedBy(readerOf(writer), writer, next, lacking);
    }
    Datagram acknowledgedBy(std::uint32_t reader, std::uint32_t writer, std::uint32_t next,
                            std::uint32_t lacking) const {
        Datagram made = *this;
        made.begin(0x06, 24);
        made.append(reader);
        made.append(writer);
        for (const std::uint32_t each : {0U, next, lacking, 1U}) made.number(each);
        return made;
    }
    Datagram counted(std::uint8_t count) const {  // as Fast DDS ends each
        Datagram made = *this;
        made.begin(0x80, 4);
        made.number(count);
        return made;
    }
    const Octets& octets() const { return octets_; }

private:
    void begin(std::uint8_t kind, std::uint8_t length) {
        octets_.push_back(kind);
        octets_.push_back(little_ ? 1 : 0);
        octets_.push_back(little_ ? length : 0);
        octets_.push_back(little_ ? 0 : length);
    }
    void number(std::uint32_t value) {
        for (int i = 0; i < 4; ++i) {
            octets_.push_back(static_cast<std::uint8_t>(value >> 8 * (little_ ? i : 3 - i)));
        }
    }
    void append(std::uint32_t entity) {
        for (int i = 3; i >= 0; --i) octets_.push_back(static_cast<std::uint8_t>(entity >> 8 * i));
    }
    void append(const Repeats::Prefix& value) {
        octets_.insert(octets_.end(), std::begin(value.value), std::end(value.value));
    }

    bool little_;
    Octets octets_;
};

class RepeatsTest : public testing::TestWithParam<bool> {
protected:
    RepeatsTest() { repeats.newcomer(prefix(2), {there}); }

    Datagram fromUs() const { return Datagram{1, GetParam()}; }
    Datagram fromThere() const { return Datagram{2, GetParam()}; }
    bool goes(const Datagram& sent, const Repeats::Locator& to, const void* socket = nullptr) {
        return !Repeats::concerns(sent.octets()) ||
               !repeats.needless(sent.octets(), socket, to, now);
    }
    int timesOf(int tries, const Datagram& sent, const Repeats::Locator& to,
                const void* socket = nullptr) {
        int times = 0;
        for (int i = 0; i < tries; ++i) times += goes(sent, to, socket);
        return times;
    }

    const Repeats::Locator there = at("10.0.0.2", 7410), all = at("239.255.0.1", 7400);
    Repeats::Clock::time_point now{};
    Repeats repeats{prefix(1), 3s};
};

TEST_P(RepeatsTest, TellsAnAddressTwiceOfUsAndThenOnceInAnInterval) {
    const Datagram us = fromUs().data(participants, 1);
    EXPECT_EQ(timesOf(10, us, there), 2);
    EXPECT_EQ(timesOf(10, us, at("10.0.0.2", 7412)), 2);
    now += 2999ms;
    EXPECT_EQ(timesOf(10, us, there), 0);
    now += 1ms;
    EXPECT_EQ(timesOf(10, us, there), 1);
    now += 1h;
    EXPECT_EQ(timesOf(10, us, there), 2);
}

TEST_P(RepeatsTest, TellsAllOfUsFiveTimes) {
    EXPECT_EQ(timesOf(10, fromUs().data(participants, 1), all), 5);
}

TEST_P(RepeatsTest, EachWayToAnAddressCounts) {
    const int socket = 0;
    const Datagram us = fromUs().data(participants, 1);
    EXPECT_EQ(timesOf(10, us, there), 2);
    EXPECT_EQ(timesOf(10, us, there, &socket), 2);
}

TEST_P(RepeatsTest, TellsWhatIsNewAtOnce) {
    EXPECT_EQ(timesOf(10, fromUs().data(participants, 1), there), 2);
    EXPECT_EQ(timesOf(10, fromUs().data(participants, 2), there), 2);
}

TEST_P(RepeatsTest, TheCountAtTheEndIsNothingNew) {
    int times = 0;
    for (std::uint8_t i = 0; i < 10; ++i) {
        times += goes(fromUs().data(participants, 1).counted(i), there);
    }
    EXPECT_EQ(times, 2);
}

TEST_P(RepeatsTest, TellsANewcomerWhatOthersThereWereTold) {
    const Datagram us = fromUs().data(participants, 1);
    EXPECT_EQ(timesOf(10, us, there), 2);
    repeats.newcomer(prefix(3), {there});
    EXPECT_EQ(timesOf(10, us, there), 2);
}

TEST_P(RepeatsTest, DoesNotAskWhoHasSaidThatHeHasAll) {
    for (const std::uint32_t writer : {publications, subscriptions}) {
        const Datagram question = fromUs().to(2).heartbeat(writer, 4).counted(1);
        EXPECT_TRUE(goes(question, there));
        repeats.heard(fromThere().to(1).acknowledged(writer, 4, 0).octets());
        EXPECT_TRUE(goes(question, there)) << "he lacks the last";
        repeats.heard(fromThere().to(1).acknowledged(writer, 5, 0).octets());
        EXPECT_FALSE(goes(question, there));
        EXPECT_TRUE(goes(question, at("10.0.0.3", 7410)));
        EXPECT_TRUE(goes(fromUs().to(2).heartbeat(writer, 5), there)) << "there is more now";
    }
}

TEST_P(RepeatsTest, AsksAgainWhoLacksSomethingOrBeganAnew) {
    const Datagram question = fromUs().heartbeat(publications, 4);
    const Octets hasAll = fromThere().to(1).acknowledged(publications, 5, 0).octets();
    repeats.heard(hasAll);
    ASSERT_FALSE(goes(question, there));
    repeats.heard(fromThere().to(1).acknowledged(publications, 5, 3).octets());
    EXPECT_TRUE(goes(question, there)) << "of some later ones he lacks three";

    repeats.heard(hasAll);
    ASSERT_FALSE(goes(question, there));
    repeats.heard(fromThere().to(1).acknowledged(publications, 0, 0).octets());
    EXPECT_TRUE(goes(question, there)) << "he has forgotten us";

    repeats.heard(hasAll);
    ASSERT_FALSE(goes(question, there));
    repeats.newcomer(prefix(2), {there});
    EXPECT_TRUE(goes(question, there)) << "he is back";

    repeats.heard(hasAll);
    ASSERT_FALSE(goes(question, there));
    repeats.gone(prefix(2));
    EXPECT_TRUE(goes(question, there));
}

TEST_P(RepeatsTest, AsksAnAddressUntilAllWhoLiveThereHaveAll) {
    const Datagram question = fromUs().heartbeat(publications, 4);
    repeats.newcomer(prefix(3), {there});
    repeats.heard(fromThere().to(1).acknowledged(publications, 5, 0).octets());
    EXPECT_TRUE(goes(question, there));
    repeats.heard(Datagram{3, GetParam()}.to(1).acknowledged(publications, 5, 0).octets());
    EXPECT_FALSE(goes(question, there));
    repeats.gone(prefix(3));
    EXPECT_FALSE(goes(question, there));
}

TEST_P(RepeatsTest, AsksOnlyWhoHasAReliableReaderThatLacksSomething) {
    const Datagram question = fromUs().heartbeat(ofUser, 4);
    EXPECT_TRUE(goes(question, there)) << "a writer that is just made";
    repeats.writerMade(entity(ofUser), "poses");
    EXPECT_FALSE(goes(question, there)) << "nobody there listens to it";

    repeats.readerFound({prefix(2), entity(theirOther)}, "other things");
    EXPECT_FALSE(goes(question, there));
    repeats.readerFound({prefix(2), entity(theirReader)}, "poses");
    repeats.readerFound({prefix(2), entity(theirOther)}, "poses");
    const Datagram back = fromThere().to(1);
    repeats.heard(back.acknowledgedBy(theirReader, ofUser, 5, 0).octets());
    EXPECT_TRUE(goes(question, there)) << "the other has not said so";
    repeats.heard(back.acknowledgedBy(theirOther, ofUser, 5, 0).octets());
    EXPECT_FALSE(goes(question, there));
    EXPECT_TRUE(goes(fromUs().heartbeat(ofUser, 5), there));

    repeats.heard(back.acknowledgedBy(theirOther, ofUser, 3, 2).octets());
    ASSERT_TRUE(goes(question, there));
    repeats.readerGone({prefix(2), entity(theirOther)});
    EXPECT_FALSE(goes(question, there));
}

TEST_P(RepeatsTest, AWriterMadeLaterFindsTheReadersThatThereAre) {
    const Datagram question = fromUs().heartbeat(ofUser, 1);
    repeats.readerFound({prefix(2), entity(theirReader)}, "poses");
    repeats.writerMade(entity(ofUser), "poses");
    EXPECT_TRUE(goes(question, there));
    repeats.heard(fromThere().to(1).acknowledged(ofUser, 2, 0).octets());
    EXPECT_FALSE(goes(question, there));

    repeats.writerGone(entity(ofUser));
    EXPECT_TRUE(goes(question, there));
    repeats.writerMade(entity(ofUser), "poses");
    EXPECT_TRUE(goes(question, there)) << "the answer was to the one before";
}

TEST_P(RepeatsTest, WithADiscoveryServerDiscoverySaysAll) {
    Repeats most{prefix(1), std::nullopt};
    most.newcomer(prefix(2), {there});
    most.heard(fromThere().to(1).acknowledged(publications, 5, 0).octets());
    for (int i = 0; i < 10; ++i) {
        EXPECT_FALSE(most.needless(fromUs().data(participants, 1).octets(), nullptr, there, now));
        EXPECT_FALSE(
            most.needless(fromUs().heartbeat(publications, 4).octets(), nullptr, there, now));
    }
    most.writerMade(entity(ofUser), "poses");
    EXPECT_TRUE(most.needless(fromUs().heartbeat(ofUser, 4).octets(), nullptr, there, now));
}

TEST_P(RepeatsTest, BelievesNoAnswerToAnother) {
    const Datagram question = fromUs().heartbeat(publications, 4);
    repeats.heard(fromThere().to(9).acknowledged(publications, 5, 0).octets());
    repeats.heard(fromThere().acknowledged(publications, 5, 0).octets());
    repeats.heard(Datagram{7, GetParam()}.to(1).acknowledged(publications, 5, 0).octets());
    repeats.heard(fromThere().to(1).acknowledged(subscriptions, 5, 0).octets());
    EXPECT_TRUE(goes(question, there));
}

TEST_P(RepeatsTest, ConcernsOnlyAnnouncementsAndQuestions) {
    EXPECT_TRUE(Repeats::concerns(fromUs().data(participants, 1).octets()));
    EXPECT_TRUE(Repeats::concerns(fromUs().to(2).heartbeat(publications, 1).octets()));
    EXPECT_FALSE(Repeats::concerns(fromUs().data(publications, 1).octets()));
    EXPECT_TRUE(Repeats::concerns(fromUs().heartbeat(ofUser, 1).octets()));
    EXPECT_FALSE(Repeats::concerns(fromUs().data(ofUser, 1).heartbeat(ofUser, 1).octets()));
    EXPECT_FALSE(Repeats::concerns(
        fromUs().heartbeat(publications, 1).acknowledged(subscriptions, 1, 0).octets()));
    EXPECT_FALSE(Repeats::concerns(fromUs().to(2).octets()));
    EXPECT_FALSE(Repeats::concerns({}));
}

INSTANTIATE_TEST_SUITE_P(InBothOrdersOfOctets, RepeatsTest, testing::Bool());

TEST(Repeats, TakesWhatIsCutOrChangedInAnyPlace) {
    std::mt19937 chance{7};
    Repeats repeats{prefix(1), 3s};
    const Repeats::Locator there = at("10.0.0.2", 7410);
    repeats.newcomer(prefix(2), {there});
    const Octets whole = Datagram{2}
                             .to(1)
                             .acknowledged(publications, 5, 0)
                             .heartbeat(publications, 4)
                             .data(participants, 1)
                             .counted(1)
                             .octets();
    for (int i = 0; i < 20'000; ++i) {
        Octets some{whole.begin(),
                    whole.begin() + static_cast<std::ptrdiff_t>(chance() % (whole.size() + 1))};
        for (int k = 0; k < 3 && !some.empty(); ++k) {
            some[chance() % some.size()] = static_cast<std::uint8_t>(chance());
        }
        repeats.heard(some);
        if (Repeats::concerns(some)) repeats.needless(some, nullptr, there, {});
    }
}

}  // namespace
}  // namespace cortex::comms
