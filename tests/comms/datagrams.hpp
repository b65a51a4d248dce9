// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Datagrams of RTPS, made byte by byte: little endian, from the participant `prefix`.
namespace cortex::comms::datagrams {

using Datagram = std::vector<std::uint8_t>;

inline void put(Datagram& to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}
inline void putNumber(Datagram& to, std::int64_t number) {
    put(to, static_cast<std::uint64_t>(number) >> 32, 4);
    put(to, static_cast<std::uint64_t>(number), 4);
}
inline void putEntity(Datagram& to, std::uint32_t entity) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        to.push_back(static_cast<std::uint8_t>(entity >> shift));
    }
}

inline Datagram header(std::uint8_t prefix = 1) {
    Datagram datagram{'R', 'T', 'P', 'S', 2, 3, 1, 15};
    datagram.resize(20, prefix);
    return datagram;
}

inline Datagram submessage(int kind, int flags, const Datagram& body) {
    Datagram all{static_cast<std::uint8_t>(kind), static_cast<std::uint8_t>(flags | 1)};
    put(all, body.size(), 2);
    all.insert(all.end(), body.begin(), body.end());
    return all;
}

inline Datagram operator+(Datagram first, const Datagram& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

constexpr std::uint32_t anyWriter = 0x00000103, discoveryWriter = 0x000100c2;

// Of a list of parameters, with padding to 4 bytes.
inline Datagram parameter(int id, Datagram content) {
    content.resize((content.size() + 3) / 4 * 4);
    Datagram all;
    put(all, static_cast<std::uint64_t>(id), 2);
    put(all, content.size(), 2);
    return all + content;
}
inline const Datagram endOfList{1, 0, 0, 0};
inline Datagram text(const std::string& characters) {
    Datagram all;
    put(all, characters.size() + 1, 4);
    for (const char each : characters) all.push_back(static_cast<std::uint8_t>(each));
    all.push_back(0);
    return all;
}

// A sample: flag 2 has parameters in front, flag 4 has data.
inline Datagram data(std::int64_t number, std::uint32_t writer = anyWriter, int flags = 4,
                     const Datagram& rest = {0, 1, 0, 0, 7, 7, 7, 7}) {
    Datagram body{0, 0, 16, 0, 0, 0, 0, 0};
    putEntity(body, writer);
    putNumber(body, number);
    return submessage(0x15, flags, body + rest);
}
// The name of the participant that header(prefix) is of.
inline Datagram guidOf(std::uint8_t prefix = 1) {
    return parameter(0x0050, Datagram(12, prefix) + Datagram{0, 0, 1, 0xc1});
}
inline Datagram announcement(const Datagram& parameters) {
    return data(1, discoveryWriter, 4, Datagram{0, 3, 0, 0} + guidOf() + parameters);
}

struct Fragment {
    std::int64_t number = 1;
    std::uint32_t first = 1;
    std::uint16_t count = 1, size = 8;
    std::uint32_t sample = 16;
    int flags = 0;
    Datagram rest = Datagram(8, 7);
    std::uint32_t writer = anyWriter;
};
inline Datagram dataFragment(const Fragment& of) {
    Datagram body{0, 0, 28, 0, 0, 0, 0, 0};
    putEntity(body, of.writer);
    putNumber(body, of.number);
    put(body, of.first, 4);
    put(body, of.count, 2);
    put(body, of.size, 2);
    put(body, of.sample, 4);
    return submessage(0x16, of.flags, body + of.rest);
}

inline Datagram heartbeat(std::int64_t first, std::int64_t last, std::uint32_t count = 1,
                          std::uint32_t writer = anyWriter) {
    Datagram body(4);
    putEntity(body, writer);
    putNumber(body, first);
    putNumber(body, last);
    put(body, count, 4);
    return submessage(0x07, 0, body);
}

inline Datagram gap(std::int64_t start, std::int64_t base, std::uint32_t bits = 0,
                    std::size_t words = 0, std::uint32_t writer = anyWriter) {
    Datagram body(4);
    putEntity(body, writer);
    putNumber(body, start);
    putNumber(body, base);
    put(body, bits, 4);
    body.resize(body.size() + 4 * words);
    return submessage(0x08, 0, body);
}

inline Datagram ackNack(std::int64_t base, std::uint32_t bits = 0, std::size_t words = 0,
                        std::uint32_t writer = anyWriter, std::uint32_t count = 0, int flags = 0) {
    Datagram body(4);
    putEntity(body, writer);
    putNumber(body, base);
    put(body, bits, 4);
    body.resize(body.size() + 4 * words);
    put(body, count, 4);
    return submessage(0x06, flags, body);
}

}  // namespace cortex::comms::datagrams
