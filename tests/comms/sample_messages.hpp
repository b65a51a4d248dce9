// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

using Octets = std::vector<std::uint8_t>;

// A message and its octets, written by hand: a hexadecimal octet, an octet so many times (00*3), a
// number of so many octets (4:7), characters ('abc').
template <class Message>
struct Sample {
    Message message;
    std::string_view layout;
};

template <class Message>
Sample<Message> sample();

// The payload that a layout describes, with its encapsulation.
Octets payloadOf(std::string_view layout, std::endian order);

// Gives every field of a message a random value; no NaN, which equals nothing.
class RandomFields {
public:
    explicit RandomFields(std::uint64_t seed) : random_(seed) {}

    void operator()(auto&... fields) { (fill(fields), ...); }

private:
    template <std::integral T>
    void fill(T& field) {
        field = static_cast<T>(random_());
    }
    void fill(bool& field) { field = below(2) == 1; }
    void fill(double& field) {
        field = std::bit_cast<double>(random_());
        if (field != field) field = std::numeric_limits<double>::infinity();
    }
    void fill(Id& field) {
        for (std::uint8_t& octet : field) fill(octet);
    }
    void fill(std::string& field) {
        field.resize(below(50) == 0 ? below(2000) : below(10));
        for (char& character : field) character = static_cast<char>(1 + below(255));
    }
    void fill(std::vector<bool>& field) {
        field.resize(below(10));
        for (std::size_t i = 0; i < field.size(); ++i) field[i] = below(2) == 1;
    }
    template <class T>
    void fill(std::vector<T>& field) {
        field.resize(below(4));
        for (T& element : field) fill(element);
    }
    template <class T>
    void fill(T& field) {
        T::visit(field, *this);
    }

    std::size_t below(std::size_t end) { return random_() % end; }

    std::mt19937_64 random_;
};

template <class Message>
Message randomMessage(std::uint64_t seed) {
    Message message;
    RandomFields{seed}(message);
    return message;
}

}  // namespace cortex::comms
