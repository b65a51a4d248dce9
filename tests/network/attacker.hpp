// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "network/host.hpp"

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace cortex::test {

// A datagram of UDP, and where it was sent to.
struct Datagram {
    std::uint32_t address = 0;  // in the byte order of the host
    std::uint16_t port = 0;
    std::vector<std::uint8_t> bytes;
};

// Somebody on a host who hears all datagrams of RTPS that pass it, and sends what he likes.
class Attacker {
public:
    Attacker(const Host& host, std::uint64_t seed);
    ~Attacker();
    Attacker(const Attacker&) = delete;
    Attacker& operator=(const Attacker&) = delete;

    // Hears for so many ms. What was heard before is forgotten, but for one in ten.
    void listen(int milliseconds);
    std::size_t heard() const { return heard_.size(); }
    // Of what was heard, changed in one to four ways: bits and numbers, lengths, kinds and order of
    // submessages, truncated, spliced with another. One in eight is as it was.
    Datagram mutated();
    // As it is, to every port at which somebody was heard to receive.
    void sendToAll(const std::vector<std::uint8_t>& bytes);
    void send(const Datagram& datagram);
    // The prefixes of all participants that were heard.
    std::vector<std::vector<std::uint8_t>> prefixes() const;
    // The ids of all writers whose samples were heard.
    std::vector<std::uint32_t> writers() const;
    // The newest sample that was heard of each writer, by the prefix of its participant and its id.
    using Writer = std::pair<std::vector<std::uint8_t>, std::uint32_t>;
    std::map<Writer, std::int64_t> newest() const;
    // An announcement of a participant, heard and said again in the name of another; empty if none.
    std::vector<std::uint8_t> announcementOf(const std::vector<std::uint8_t>& prefix) const;
    // A whole signed message that was heard, empty if none.
    std::vector<std::uint8_t> signedMessage() const;

private:
    void change(std::vector<std::uint8_t>& bytes);
    std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

    int capture_ = -1, socket_ = -1;
    std::mt19937_64 random_;
    std::vector<Datagram> heard_;
};

}  // namespace cortex::test
