// SPDX-License-Identifier: Apache-2.0
#include "wire/cdr.hpp"

#include "sample_messages.hpp"
#include "support/share.hpp"

#include <algorithm>

#include <fastcdr/Cdr.h>
#include <gtest/gtest.h>

namespace cortex::comms {
namespace {

template <class Message>
Octets encoded(const Message& message) {
    Octets payload(encodedSize(message));
    payload.resize(encode(message, payload));
    return payload;
}

// The same octets made by another library, which leaves padding as the memory was: zero.
class FastCdr {
public:
    explicit FastCdr(std::endian order)
        : buffer_(reinterpret_cast<char*>(memory_.data()), memory_.size()),
          cdr_(buffer_,
               order == std::endian::little ? eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS
                                            : eprosima::fastcdr::Cdr::BIG_ENDIANNESS,
               eprosima::fastcdr::Cdr::DDS_CDR) {
        cdr_.serialize_encapsulation();
    }

    template <class Message>
    Octets encode(const Message& message) {
        (*this)(message);
        memory_.resize(cdr_.getSerializedDataLength());
        return memory_;
    }

    void operator()(const auto&... fields) { (put(fields), ...); }

private:
    template <class T>
    void put(const T& field) {
        if constexpr (requires(T& message) { T::visit(message, [](auto&...) {}); }) {
            T::visit(field, *this);
        } else {
            cdr_ << field;
        }
    }
    void put(const std::vector<bool>& field) { cdr_ << field; }
    template <class T>
    void put(const std::vector<T>& field) {
        cdr_ << static_cast<std::uint32_t>(field.size());
        for (const T& element : field) put(element);
    }

    Octets memory_ = Octets(200'000);
    eprosima::fastcdr::FastBuffer buffer_;
    eprosima::fastcdr::Cdr cdr_;
};

template <class Message>
class Cdr : public testing::Test {};

struct ShortNames {
    template <class Message>
    static std::string GetName(int) {
        return std::string{Message::typeName}.substr(sizeof "cortex::" - 1);
    }
};
using Messages = testing::Types<Presence, Model, Interest, Block, Summary, Command, Answer,
                                EventMessage, PastMessage>;
TYPED_TEST_SUITE(Cdr, Messages, ShortNames);

TYPED_TEST(Cdr, WritesTheOctetsOfTheSpecification) {
    const auto [message, layout] = sample<TypeParam>();

    EXPECT_EQ(encoded(message), payloadOf(layout, std::endian::little));
}

TYPED_TEST(Cdr, ReadsBothByteOrders) {
    const auto [message, layout] = sample<TypeParam>();

    for (const std::endian order : {std::endian::little, std::endian::big}) {
        TypeParam read;
        EXPECT_TRUE(decode(payloadOf(layout, order), read));
        EXPECT_EQ(read, message);
    }
}

TYPED_TEST(Cdr, BringsRandomMessagesBack) {
    TypeParam read;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const TypeParam message = randomMessage<TypeParam>(seed);

        const Octets payload = encoded(message);

        ASSERT_EQ(payload.size(), encodedSize(message)) << "seed " << seed;
        ASSERT_TRUE(decode(payload, read)) << "seed " << seed;
        ASSERT_EQ(read, message) << "seed " << seed;
    }
}

TYPED_TEST(Cdr, AgreesWithFastCdr) {
    TypeParam read;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const TypeParam message = randomMessage<TypeParam>(seed);

        ASSERT_EQ(encoded(message), FastCdr{std::endian::little}.encode(message))
            << "seed " << seed;
        ASSERT_TRUE(decode(FastCdr{std::endian::big}.encode(message), read)) << "seed " << seed;
        ASSERT_EQ(read, message) << "seed " << seed;
    }
}

TYPED_TEST(Cdr, RefusesEveryTruncation) {
    for (const TypeParam& message : {sample<TypeParam>().message, randomMessage<TypeParam>(1)}) {
        const Octets payload = encoded(message);
        for (auto end = payload.begin(); end != payload.end(); ++end) {
            TypeParam read;
            EXPECT_FALSE(decode(Octets(payload.begin(), end), read)) << end - payload.begin();
        }
    }
}

// What is accepted is a message of the same length that can be sent and read again. In the gate
// each octet is changed to 26 others.
TYPED_TEST(Cdr, RefusesAMutatedOctetOrReadsAPossibleMessage) {
    const Octets payload = encoded(sample<TypeParam>().message);
    Octets mutated = payload;
    const std::size_t step = test::isWhole() ? 1 : 10;
    for (std::size_t place = 0; place < payload.size(); ++place) {
        for (std::size_t change = 1 + place % step; change < 256; change += step) {
            TypeParam read, again;
            mutated[place] = static_cast<std::uint8_t>(payload[place] ^ change);
            if (!decode(mutated, read)) continue;

            const Octets written = encoded(read);
            ASSERT_LE(written.size(), mutated.size()) << "octet " << place << " ^ " << change;
            ASSERT_GE(written.size() + 3, mutated.size()) << "octet " << place << " ^ " << change;
            ASSERT_TRUE(decode(written, again)) << "octet " << place << " ^ " << change;
            ASSERT_EQ(encoded(again), written) << "octet " << place << " ^ " << change;
        }
        mutated[place] = payload[place];
    }
}

TYPED_TEST(Cdr, LetsThreeOctetsOfPaddingFollow) {
    const TypeParam message = sample<TypeParam>().message;
    Octets payload = encoded(message);
    TypeParam read;
    for (int padding = 1; padding <= 3; ++padding) {
        payload.push_back(0);
        EXPECT_TRUE(decode(payload, read)) << padding;
        EXPECT_EQ(read, message) << padding;
    }
    payload.push_back(0);
    EXPECT_FALSE(decode(payload, read));
}

TYPED_TEST(Cdr, WritesNothingWhereThereIsNoRoom) {
    const TypeParam message = sample<TypeParam>().message;
    const std::size_t size = encodedSize(message);
    Octets memory(size, 0xee);
    for (std::size_t room = 0; room < size; ++room) {
        EXPECT_EQ(encode(message, std::span{memory}.first(room)), 0U) << room;
    }
    EXPECT_EQ(std::ranges::count(memory, 0xee), std::ssize(memory));
    EXPECT_EQ(encode(message, memory), size);
}

TYPED_TEST(Cdr, ReadsNoOtherEncapsulation) {
    Octets payload = encoded(sample<TypeParam>().message);
    TypeParam read;
    for (const auto& [first, second] :
         {std::pair{0, 2}, {0, 3}, {0, 6}, {0, 7}, {1, 1}, {255, 255}}) {
        payload[0] = static_cast<std::uint8_t>(first);
        payload[1] = static_cast<std::uint8_t>(second);
        EXPECT_FALSE(decode(payload, read)) << first << ' ' << second;
    }
}

// The octets of an event up to its last field, extras.
Octets eventWith(std::string_view extras) {
    const std::string start =
        "00*16 4:1 00 00*3 8:0 8:0 8:0 8:0 4:1 00 00*3 4:1 00 00*3 4:1 00 00*3 ";
    return payloadOf(start + std::string{extras}, std::endian::little);
}

bool readsEvent(std::string_view text) {
    EventMessage read;
    return decode(eventWith(std::string{text} + " 4:0"), read);
}

TEST(CdrText, EndsInItsOnlyNul) {
    EXPECT_TRUE(readsEvent("4:4 'abc' 00"));
    EXPECT_FALSE(readsEvent("4:4 'abcd'"));
    EXPECT_FALSE(readsEvent("4:4 'ab' 00*2"));
    EXPECT_FALSE(readsEvent("4:4 00 'ab' 00"));
    EXPECT_FALSE(readsEvent("4:0"));
    EXPECT_FALSE(readsEvent("4:4294967295 'abc' 00"));
}

TEST(CdrText, IsNoLongerThan64KiB) {
    EventMessage message, read;
    message.text.assign(maxTextLength, 'x');
    EXPECT_TRUE(decode(encoded(message), read));
    EXPECT_EQ(read, message);

    message.text += 'x';
    EXPECT_TRUE(encoded(message).empty());
    EXPECT_FALSE(decode(FastCdr{std::endian::little}.encode(message), read));
}

TEST(CdrText, IsSentUpToItsFirstNul) {
    EventMessage message, read;
    message.text = std::string{"a\0b", 3};
    message.kind = std::string(1, '\0');

    ASSERT_TRUE(decode(encoded(message), read));
    EXPECT_EQ(read.text, "a");
    EXPECT_EQ(read.kind, "");
}

TEST(CdrBool, IsZeroOrOne) {
    Octets payload = encoded(sample<Block>().message);
    const std::size_t keyFrame = 4 + 72, bools = 4 + 156;
    Block read;
    for (const std::size_t place : {keyFrame, bools, bools + 1, bools + 2}) {
        const std::uint8_t before = payload[place];
        ASSERT_LE(before, 1) << place;
        payload[place] = 2;
        EXPECT_FALSE(decode(payload, read)) << place;
        payload[place] = before ^ 1;
        EXPECT_TRUE(decode(payload, read)) << place;
        payload[place] = before;
    }
}

TEST(CdrSequence, ReservesNothingForElementsThatThePayloadCannotHold) {
    for (const char* count : {"4:2", "4:1000000", "4:4294967295"}) {
        EventMessage read;
        EXPECT_FALSE(decode(eventWith("4:1 00 00*3 " + std::string{count} + " 00*19"), read));
        EXPECT_EQ(read.extras.capacity(), 0U) << count;
    }
}

TEST(CdrSequence, KeepsItsMemoryWhenAMessageIsReadAgain) {
    Block message = sample<Block>().message, read;
    ASSERT_TRUE(decode(encoded(message), read));
    const double* memory = read.simplexes[0].floats.data();
    message.simplexes[0].floats = {2.5};

    ASSERT_TRUE(decode(encoded(message), read));

    EXPECT_EQ(read, message);
    EXPECT_EQ(read.simplexes[0].floats.data(), memory);
}

}  // namespace
}  // namespace cortex::comms
