// SPDX-License-Identifier: Apache-2.0
// One participant loses another, as after a silence, and meets it anew.
#include "comms/datagrams.hpp"
#include "comms/inbox.hpp"
#include "dds/participant.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

namespace cortex::comms {
namespace {

using datagrams::Datagram, datagrams::operator+;

constexpr int portsAsked = 8;  // participants of the loopback interface that are asked one by one

// Somebody who hears how participants announce themselves, and speaks in their names.
class Forger {
public:
    Forger() : socket_{socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
        const sockaddr_in address = portOf(portsAsked - 1);
        if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("no port");
    }
    ~Forger() { close(socket_); }

    // The newest announcement of the participant with that name.
    std::optional<Datagram> heard(std::string_view name) {
        std::array<std::uint8_t, 4096> octets;
        for (;;) {
            const ssize_t size = recv(socket_, octets.data(), octets.size(), MSG_DONTWAIT);
            if (size <= 0) return newest_;
            const std::string_view all{reinterpret_cast<const char*>(octets.data()),
                                       static_cast<std::size_t>(size)};
            if (all.find(name) == all.npos) continue;
            newest_.emplace(octets.begin(), octets.begin() + size);
        }
    }
    enum Port { Discovery, Values };
    void sendToAll(const Datagram& datagram, Port port = Discovery) const {
        for (int number = 0; number + 1 < portsAsked; ++number) {
            const sockaddr_in to = portOf(number, port);
            sendto(socket_, datagram.data(), datagram.size(), 0,
                   reinterpret_cast<const sockaddr*>(&to), sizeof to);
        }
    }

private:
    static sockaddr_in portOf(int participant, Port port = Discovery) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(
            static_cast<std::uint16_t>(7410 + 250 * test::ownDomain() + 2 * participant + port));
        return address;
    }

    int socket_;
    std::optional<Datagram> newest_;
};

// Where the submessage with an announcement begins.
std::size_t placeOf(const Datagram& announcement) {
    std::size_t at = 20;
    while (announcement.at(at) != 0x15) {
        at += 4U + announcement.at(at + 2) + 256U * announcement.at(at + 3);
    }
    return at;
}

// The header of an announcement, and that its participant is gone, with the next number.
Datagram goodbyeOf(const Datagram& announcement) {
    const Datagram header(announcement.begin(), announcement.begin() + 20);
    const Datagram guid = Datagram(header.begin() + 8, header.end()) + Datagram{0, 0, 1, 0xc1};
    const std::size_t at = placeOf(announcement);
    Datagram body{0, 0, 16, 0, 0, 0, 0, 0};
    datagrams::putEntity(body, datagrams::discoveryWriter);
    std::int64_t number = 0;
    for (std::size_t i = 4; i-- > 0;) number = number << 8 | announcement.at(at + 20 + i);
    datagrams::putNumber(body, number + 1);
    constexpr int keyHash = 0x70, statusInfo = 0x71, participantGuid = 0x50;
    constexpr int inlineQos = 2, onlyKey = 8;
    return header + datagrams::submessage(0x15, inlineQos | onlyKey,
                                          body + datagrams::parameter(keyHash, guid) +
                                              datagrams::parameter(statusInfo, {0, 0, 0, 3}) +
                                              datagrams::endOfList + Datagram{0, 3, 0, 0} +
                                              datagrams::parameter(participantGuid, guid) +
                                              datagrams::endOfList);
}

// Where a heartbeat comes before Fast DDS asks for everything, it never does.
TEST(ParticipantsThatLoseOneAnother, MeetAgainAlsoWhereAHeartbeatCameFirst) {
    Forger forger;
    Participant one{loopback(), "one-that-stays"}, other{loopback(), "other"};
    Inbox<Presence> inbox;
    const auto writer = one.writer<Presence>(topics::presence);
    const auto reader = other.reader<Presence>(topics::presence, inbox.push());
    ASSERT_TRUE(comesTrue([&] { return reader->writers() == 1; }));
    std::optional<Datagram> announcement;
    ASSERT_TRUE(comesTrue([&] {
        one.announce();
        return (announcement = forger.heard("one-that-stays")).has_value();
    }));

    for (int round = 0; round < 3; ++round) {
        ASSERT_TRUE(comesTrue([&] {
            forger.sendToAll(goodbyeOf(*(announcement = forger.heard("one-that-stays"))));
            return reader->writers() == 0;
        }));
        const Datagram header(announcement->begin(), announcement->begin() + 20);
        const Datagram ofWriters = header + datagrams::heartbeat(1, 1, 1, 0x000003c2);
        ASSERT_TRUE(comesTrue([&] {
            one.announce();
            forger.sendToAll(ofWriters);
            return reader->writers() == 1;
        })) << round;
    }
    inbox.take();
    EXPECT_TRUE(comesTrue([&] {
        writer->write(Presence{});
        return !inbox.elements().empty();
    }));
}

// Somebody counts ahead in its name, in steps that any writer takes that lost some.
TEST(ParticipantsThatLoseOneAnother, SayThatTheySkipWhatOneWritesAndANewReaderHearsIt) {
    constexpr std::uint32_t firstWriter = 0x00000102;
    Forger forger;
    Participant one{loopback(), "one-that-speaks"}, other{loopback(), "other"};
    Inbox<Presence> inbox;
    const auto writer = one.writer<Presence>(topics::presence);
    const Topic asAgents{topics::presence.name, Qos::Cycle};
    auto reader = other.reader<Presence>(asAgents, inbox.push());
    const auto hears = [&] {
        inbox.take();
        return comesTrue([&] {
            writer->write(Presence{});
            return !inbox.elements().empty();
        });
    };
    ASSERT_TRUE(hears());
    std::optional<Datagram> announcement;
    ASSERT_TRUE(comesTrue([&] {
        one.announce();
        return (announcement = forger.heard("one-that-speaks")).has_value();
    }));
    const Datagram header(announcement->begin(), announcement->begin() + 20);
    EXPECT_FALSE(reader->isDeaf());

    const Datagram keyAndRest = datagrams::parameter(0x70, Datagram(16, 5)) + datagrams::endOfList +
                                Datagram{0, 1, 0, 0, 7, 7, 7, 7};
    for (std::int64_t number = 2; number < 3'000; number += 3) {
        forger.sendToAll(header + datagrams::data(number, firstWriter, 6, keyAndRest),
                         Forger::Values);
        std::this_thread::sleep_for(std::chrono::microseconds{100});  // so that few are lost
    }
    EXPECT_TRUE(comesTrue([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds{20});
        writer->write(Presence{});
        return reader->isDeaf();
    }));

    reader = other.reader<Presence>(asAgents, inbox.push());
    EXPECT_TRUE(hears());
    EXPECT_FALSE(reader->isDeaf());
}

}  // namespace
}  // namespace cortex::comms
