// SPDX-License-Identifier: Apache-2.0
#include "wire/cdr.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace cortex::comms {
namespace {

constexpr std::array<std::uint8_t, 4> littleEndianHeader = {0, 1, 0, 0};
constexpr std::size_t headerSize = littleEndianHeader.size();
constexpr std::size_t maxPadding = 3;

template <class T>
concept Number = std::is_arithmetic_v<T> && !std::same_as<T, bool>;

template <class T>
concept Struct = requires(T& message) { T::visit(message, [](auto&...) {}); };

constexpr std::size_t aligned(std::size_t offset, std::size_t alignment) {
    return (offset + alignment - 1) & ~(alignment - 1);
}

template <Number T>
void swapOctets(std::uint8_t* numbers, std::size_t count) {
    for (std::uint8_t* end = numbers + count * sizeof(T); numbers != end; numbers += sizeof(T)) {
        std::reverse(numbers, numbers + sizeof(T));
    }
}

// Writes one field after another, or only counts their octets. Offsets count from the end of the
// header.
template <bool Writes>
class Encoder {
public:
    explicit Encoder(std::uint8_t* body = nullptr) : body_(body) {}

    std::size_t size() const { return size_; }
    bool ok() const { return ok_; }

    void operator()(const auto&... fields) { (put(fields), ...); }

private:
    void put(const Number auto& field) { putNumbers(&field, 1); }
    void put(const std::same_as<bool> auto& field) {
        const std::uint8_t octet = field ? 1 : 0;
        putNumbers(&octet, 1);
    }
    void put(const Id& field) { putNumbers(field.data(), field.size()); }
    void put(const std::string& field) {
        const std::size_t size = std::strlen(field.c_str());  // a NUL ends it
        putCount(size + 1);
        ok_ = ok_ && size <= maxTextLength;
        putNumbers(field.c_str(), size + 1);
    }
    void put(const std::vector<bool>& field) {
        putCount(field.size());
        if constexpr (Writes) std::copy(field.begin(), field.end(), body_ + size_);
        size_ += field.size();
    }
    template <Number T>
    void put(const std::vector<T>& field) {
        putCount(field.size());
        if (!field.empty()) putNumbers(field.data(), field.size());
    }
    template <class T>
    void put(const std::vector<T>& field) {
        putCount(field.size());
        for (const T& element : field) put(element);
    }
    void put(const Struct auto& field) { field.visit(field, *this); }

    void putCount(std::size_t count) {
        const auto number = static_cast<std::uint32_t>(count);
        putNumbers(&number, 1);
    }

    template <Number T>
    void putNumbers(const T* numbers, std::size_t count) {
        const std::size_t start = aligned(size_, sizeof(T));
        if constexpr (Writes) {
            std::fill(body_ + size_, body_ + start, std::uint8_t{0});
            std::memcpy(body_ + start, numbers, count * sizeof(T));
            if constexpr (std::endian::native == std::endian::big) {
                swapOctets<T>(body_ + start, count);
            }
        }
        size_ = start + count * sizeof(T);
    }

    std::uint8_t* body_;
    std::size_t size_ = 0;
    bool ok_ = true;
};

// Counts the octets that any value of a type needs at least: strings and sequences empty.
class SmallestSize {
public:
    template <class T>
    static std::size_t of() {
        SmallestSize size;
        size.add(T{});
        return size.octets_;
    }

    void operator()(const auto&... fields) { (add(fields), ...); }

private:
    template <Number T>
    void add(const T&) {
        octets_ += sizeof(T);
    }
    void add(const std::same_as<bool> auto&) { octets_ += 1; }
    void add(const Id& field) { octets_ += field.size(); }
    void add(const std::string&) { octets_ += sizeof(std::uint32_t) + 1; }
    template <class T>
    void add(const std::vector<T>&) {
        octets_ += sizeof(std::uint32_t);
    }
    void add(const Struct auto& field) { field.visit(field, *this); }

    std::size_t octets_ = 0;
};

// Reads one field after another. After the first malformed one it reads nothing more.
class Decoder {
public:
    Decoder(std::span<const std::uint8_t> body, bool swaps) : body_(body), swaps_(swaps) {}

    bool complete() const { return ok_ && body_.size() - position_ <= maxPadding; }

    void operator()(auto&... fields) { (read(fields), ...); }

private:
    void read(Number auto& field) { takeNumbers(&field, 1); }
    void read(bool& field) {
        const std::uint8_t* octet = take(1, 1);
        ok_ = ok_ && *octet <= 1;
        if (ok_) field = *octet == 1;
    }
    void read(Id& field) { takeNumbers(field.data(), field.size()); }
    void read(std::string& field) {
        const std::size_t size = takeCount(1);
        ok_ = ok_ && size >= 1 && size - 1 <= maxTextLength;
        const std::uint8_t* text = take(size, 1);
        ok_ = ok_ && std::memchr(text, 0, size) == text + size - 1;
        if (ok_) field.assign(reinterpret_cast<const char*>(text), size - 1);
    }
    void read(std::vector<bool>& field) {
        const std::size_t count = takeCount(1);
        const std::uint8_t* octets = take(count, 1);
        ok_ = ok_ &&
              std::all_of(octets, octets + count, [](std::uint8_t octet) { return octet <= 1; });
        if (ok_) field.assign(octets, octets + count);
    }
    template <Number T>
    void read(std::vector<T>& field) {
        field.resize(takeCount(sizeof(T)));
        if (!field.empty()) takeNumbers(field.data(), field.size());
    }
    template <class T>
    void read(std::vector<T>& field) {
        field.resize(takeCount(SmallestSize::of<T>()));
        for (auto element = field.begin(); ok_ && element != field.end(); ++element) {
            read(*element);
        }
    }
    void read(Struct auto& field) { field.visit(field, *this); }

    // The place of the next octets. Null: fewer octets are left.
    const std::uint8_t* take(std::size_t octets, std::size_t alignment) {
        const std::size_t start = aligned(position_, alignment);
        ok_ = ok_ && start <= body_.size() && octets <= body_.size() - start;
        if (!ok_) return nullptr;
        position_ = start + octets;
        return body_.data() + start;
    }

    // The length of a sequence. 0: the octets that are left cannot hold so many elements.
    std::size_t takeCount(std::size_t smallestElement) {
        std::uint32_t count = 0;
        takeNumbers(&count, 1);
        ok_ = ok_ && count <= (body_.size() - position_) / smallestElement;
        return ok_ ? count : 0;
    }

    template <Number T>
    void takeNumbers(T* numbers, std::size_t count) {
        const std::uint8_t* octets = take(count * sizeof(T), sizeof(T));
        if (octets == nullptr) return;
        std::memcpy(numbers, octets, count * sizeof(T));
        if (swaps_) swapOctets<T>(reinterpret_cast<std::uint8_t*>(numbers), count);
    }

    std::span<const std::uint8_t> body_;
    bool swaps_;
    std::size_t position_ = 0;
    bool ok_ = true;
};

}  // namespace

template <class Message>
std::size_t encodedSize(const Message& message) {
    Encoder<false> counter;
    counter(message);
    return headerSize + counter.size();
}

template <class Message>
std::size_t encode(const Message& message, std::span<std::uint8_t> payload) {
    if (encodedSize(message) > payload.size()) return 0;
    std::ranges::copy(littleEndianHeader, payload.begin());
    Encoder<true> encoder{payload.data() + headerSize};
    encoder(message);
    return encoder.ok() ? headerSize + encoder.size() : 0;
}

template <class Message>
bool canEncode(const Message& message) {
    Encoder<false> counter;
    counter(message);
    return counter.ok();
}

template <class Message>
bool decode(std::span<const std::uint8_t> payload, Message& message) {
    if (payload.size() < headerSize || payload[0] != 0 || payload[1] > 1) return false;
    const bool little = payload[1] == 1;
    Decoder decoder{payload.subspan(headerSize),
                    little != (std::endian::native == std::endian::little)};
    decoder(message);
    return decoder.complete();
}

template std::size_t encodedSize(const Presence&);
template std::size_t encodedSize(const Model&);
template std::size_t encodedSize(const Interest&);
template std::size_t encodedSize(const Block&);
template std::size_t encodedSize(const Summary&);
template std::size_t encodedSize(const Command&);
template std::size_t encodedSize(const Answer&);
template std::size_t encodedSize(const EventMessage&);
template std::size_t encodedSize(const PastMessage&);

template std::size_t encode(const Presence&, std::span<std::uint8_t>);
template std::size_t encode(const Model&, std::span<std::uint8_t>);
template std::size_t encode(const Interest&, std::span<std::uint8_t>);
template std::size_t encode(const Block&, std::span<std::uint8_t>);
template std::size_t encode(const Summary&, std::span<std::uint8_t>);
template std::size_t encode(const Command&, std::span<std::uint8_t>);
template std::size_t encode(const Answer&, std::span<std::uint8_t>);
template std::size_t encode(const EventMessage&, std::span<std::uint8_t>);
template std::size_t encode(const PastMessage&, std::span<std::uint8_t>);

template bool canEncode(const Presence&);
template bool canEncode(const Model&);
template bool canEncode(const Interest&);
template bool canEncode(const Block&);
template bool canEncode(const Summary&);
template bool canEncode(const Command&);
template bool canEncode(const Answer&);
template bool canEncode(const EventMessage&);
template bool canEncode(const PastMessage&);

template bool decode(std::span<const std::uint8_t>, Presence&);
template bool decode(std::span<const std::uint8_t>, Model&);
template bool decode(std::span<const std::uint8_t>, Interest&);
template bool decode(std::span<const std::uint8_t>, Block&);
template bool decode(std::span<const std::uint8_t>, Summary&);
template bool decode(std::span<const std::uint8_t>, Command&);
template bool decode(std::span<const std::uint8_t>, Answer&);
template bool decode(std::span<const std::uint8_t>, EventMessage&);
template bool decode(std::span<const std::uint8_t>, PastMessage&);

}  // namespace cortex::comms
