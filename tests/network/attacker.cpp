// SPDX-License-Identifier: Apache-2.0
#include "network/attacker.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>
#include <stdexcept>

#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace cortex::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t mostHeard = 16'384, header = 20;
constexpr std::uint8_t data = 0x15, dataFragments = 0x16;  // kinds of submessage

[[noreturn]] void failWith(const std::string& what) {
    throw std::runtime_error(what + ": " + std::strerror(errno));
}

// Of a packet of IPv4; empty unless it is UDP with a message of RTPS.
Datagram datagramIn(const std::uint8_t* packet, std::size_t size) {
    const std::size_t ip = size > 0 ? static_cast<std::size_t>(packet[0] & 15) * 4 : 0;
    if (ip < 20 || size < ip + 8 + header || packet[9] != IPPROTO_UDP) return {};
    const std::uint8_t* const udp = packet + ip;
    if (std::memcmp(udp + 8, "RTPS", 4) != 0) return {};
    std::uint32_t address = 0;
    std::memcpy(&address, packet + 16, 4);
    return {
        ntohl(address), static_cast<std::uint16_t>(udp[2] << 8 | udp[3]), {udp + 8, packet + size}};
}

// Where the submessages of a message begin, as far as their lengths say so.
std::vector<std::size_t> submessagesOf(const std::vector<std::uint8_t>& bytes) {
    std::vector<std::size_t> begins;
    for (std::size_t at = header; at + 4 <= bytes.size();) {
        begins.push_back(at);
        const std::size_t length = static_cast<std::size_t>(bytes[at + 2] | bytes[at + 3] << 8);
        if (length == 0) break;
        at += 4 + length;
    }
    return begins;
}

}  // namespace

Attacker::Attacker(const Host& host, std::uint64_t seed) : random_{seed} {
    host.within([this] {
        capture_ = socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP));
        if (capture_ < 0) failWith("a socket for all packets");
        socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
        if (socket_ < 0) failWith("a socket");
    });
}

Attacker::~Attacker() {
    close(capture_);
    close(socket_);
}

void Attacker::listen(int milliseconds) {
    std::vector<Datagram> kept;
    for (std::size_t i = 0; i < heard_.size(); i += 10) kept.push_back(std::move(heard_[i]));
    heard_ = std::move(kept);
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds{milliseconds};
    std::array<std::uint8_t, 65536> packet;
    while (std::chrono::steady_clock::now() < end && heard_.size() < mostHeard) {
        pollfd ready{capture_, POLLIN, 0};
        if (poll(&ready, 1, 5) <= 0) continue;
        const ssize_t size = recv(capture_, packet.data(), packet.size(), MSG_DONTWAIT);
        if (size <= 0) continue;
        Datagram datagram = datagramIn(packet.data(), static_cast<std::size_t>(size));
        if (!datagram.bytes.empty()) heard_.push_back(std::move(datagram));
    }
}

void Attacker::send(const Datagram& datagram) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(datagram.address);
    to.sin_port = htons(datagram.port);
    // A socket whose buffer is full, or a port that nobody has, is none of our business.
    sendto(socket_, datagram.bytes.data(), datagram.bytes.size(), 0,
           reinterpret_cast<const sockaddr*>(&to), sizeof to);
}

void Attacker::sendToAll(const std::vector<std::uint8_t>& bytes) {
    std::set<std::pair<std::uint32_t, std::uint16_t>> ports;
    for (const Datagram& each : heard_) ports.emplace(each.address, each.port);
    for (const auto& [address, port] : ports) send({address, port, bytes});
}

std::vector<std::vector<std::uint8_t>> Attacker::prefixes() const {
    std::set<std::vector<std::uint8_t>> all;
    for (const Datagram& each : heard_) {
        all.insert({each.bytes.begin() + 8, each.bytes.begin() + header});
    }
    return {all.begin(), all.end()};
}

std::vector<std::uint32_t> Attacker::writers() const {
    std::set<std::uint32_t> all;
    for (const auto& [writer, number] : newest()) all.insert(writer.second);
    return {all.begin(), all.end()};
}

std::map<Attacker::Writer, std::int64_t> Attacker::newest() const {
    std::map<Writer, std::int64_t> all;
    for (const Datagram& each : heard_) {
        const Bytes& bytes = each.bytes;
        for (const std::size_t at : submessagesOf(bytes)) {
            const bool isSample = bytes[at] == data || bytes[at] == dataFragments;
            if (!isSample || at + 24 > bytes.size()) continue;
            std::array<std::uint32_t, 3> words{};  // the writer, and both halves of the number
            std::memcpy(words.data(), &bytes[at + 12], sizeof words);
            std::int64_t& number =
                all[{{bytes.begin() + 8, bytes.begin() + header}, ntohl(words[0])}];
            number = std::max(number, static_cast<std::int64_t>(words[1]) << 32 | words[2]);
        }
    }
    return all;
}

std::vector<std::uint8_t> Attacker::announcementOf(const std::vector<std::uint8_t>& prefix) const {
    constexpr std::array<std::uint8_t, 4> writer{0, 1, 0, 0xc2};
    for (const Datagram& each : heard_) {
        Bytes bytes = each.bytes;
        for (const std::size_t at : submessagesOf(bytes)) {
            if (bytes[at] != data || at + 16 > bytes.size() ||
                !std::equal(writer.begin(), writer.end(), &bytes[at + 12]))
                continue;
            const Bytes own{bytes.begin() + 8, bytes.begin() + header};
            for (auto place = bytes.begin(); place != bytes.end(); ++place) {
                place = std::search(place, bytes.end(), own.begin(), own.end());
                if (place == bytes.end()) break;
                std::ranges::copy(prefix, place);
            }
            return bytes;
        }
    }
    return {};
}

std::vector<std::uint8_t> Attacker::signedMessage() const {
    constexpr std::uint8_t signedPrefix = 0x33;
    for (const Datagram& each : heard_) {
        if (each.bytes.size() > header && each.bytes[header] == signedPrefix) return each.bytes;
    }
    return {};
}

Datagram Attacker::mutated() {
    Datagram datagram = heard_[below(heard_.size())];
    if (below(8) == 0) return datagram;
    for (std::uint64_t changes = 1 + below(4); changes > 0; --changes) change(datagram.bytes);
    return datagram;
}

void Attacker::change(std::vector<std::uint8_t>& bytes) {
    constexpr std::array<std::uint8_t, 8> extremes{0, 1, 2, 0x7f, 0x80, 0xfe, 0xff, 0x40};
    const std::vector<std::size_t> begins = submessagesOf(bytes);
    if (bytes.size() <= header || begins.empty()) return;
    const std::size_t submessage = begins[below(begins.size())];
    const std::size_t any = header + below(bytes.size() - header);
    // Nearly everything stands within the first 40 bytes of a submessage.
    const std::size_t near = std::min(submessage + below(44), bytes.size() - 1);
    switch (below(12)) {
        case 0:
            bytes[any] ^= static_cast<std::uint8_t>(1U << below(8));
            break;
        case 1:
            bytes[any] = extremes[below(extremes.size())];
            break;
        case 2:
            bytes[near] = extremes[below(extremes.size())];
            break;
        case 3:
            bytes[near] ^= static_cast<std::uint8_t>(1U << below(8));
            break;
        case 4:  // four bytes of a number
            for (std::size_t i = near & ~3U; i < std::min((near & ~3U) + 4, bytes.size()); ++i) {
                bytes[i] = static_cast<std::uint8_t>(random_());
            }
            break;
        case 5:  // another kind
            bytes[submessage] = std::array<std::uint8_t, 10>{
                0x01, 0x06, 0x07, 0x08, 0x12, 0x15, 0x16, 0x33, 0x34, 0x80}[below(10)];
            break;
        case 6:  // another length
            bytes[std::min(submessage + 2 + below(2), bytes.size() - 1)] =
                static_cast<std::uint8_t>(random_());
            break;
        case 7:
            bytes.resize(header + below(bytes.size() - header + 1));
            break;
        case 8: {  // what another one has behind its header
            const auto& other = heard_[below(heard_.size())].bytes;
            bytes.insert(bytes.end(), other.begin() + header, other.end());
            break;
        }
        case 9: {  // a submessage twice
            const std::vector<std::uint8_t> again{
                bytes.begin() + static_cast<std::ptrdiff_t>(submessage), bytes.end()};
            bytes.insert(bytes.end(), again.begin(), again.end());
            break;
        }
        case 10: {  // in the name of another
            const auto& other = heard_[below(heard_.size())].bytes;
            std::copy_n(other.begin() + 8, 12, bytes.begin() + 8);
            break;
        }
        default:  // statistics of Fast DDS somewhere
            bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(submessage), 60, 0);
            bytes[submessage] = 0x80;
            bytes[submessage + 1] = 1;
            bytes[submessage + 2] = 56;
            break;
    }
    if (bytes.size() > 65'000) bytes.resize(65'000);
}

}  // namespace cortex::test
