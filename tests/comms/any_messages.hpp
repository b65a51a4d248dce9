// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comms/sample_messages.hpp"
#include "dds/topics.hpp"
#include "wire/cdr.hpp"
#include "wire/ids.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// Messages of random content and size, the same ones in each process that knows their seed.
namespace cortex::comms {

inline constexpr const char* anySender = "from";  // whose messages they are, where that is proved

// All kinds of messages on their topics. Calls `f.operator()<M>(topic)` for the one of that name.
template <class F>
void forKind(std::string_view kind, F&& f) {
    if (kind == "presence") f.template operator()<Presence>(topics::presence);
    if (kind == "model") f.template operator()<Model>(topics::model);
    if (kind == "interest") f.template operator()<Interest>(topics::interest);
    if (kind == "view") f.template operator()<Block>(topics::viewEvery);
    if (kind == "link") f.template operator()<Block>(topics::linkOf("to"));
    if (kind == "summary") f.template operator()<Summary>(topics::summary);
    if (kind == "command") f.template operator()<Command>(topics::command);
    if (kind == "answer") f.template operator()<Answer>(topics::answerTo("to"));
    if (kind == "event") f.template operator()<EventMessage>(topics::event);
    if (kind == "past") f.template operator()<PastMessage>(topics::past);
}

// The content of a message as octets, in a form of this test's own.
class Content {
public:
    template <class M>
    static Octets of(const M& message) {
        Content content;
        M::visit(message, content);
        return content.octets_;
    }

    void operator()(const auto&... fields) { (put(fields), ...); }

private:
    template <class T>
    void put(const T& field) {
        if constexpr (requires { T::visit(field, *this); }) {
            T::visit(field, *this);
        } else if constexpr (requires { field.size(); }) {
            put(static_cast<std::uint64_t>(field.size()));
            if constexpr (std::is_arithmetic_v<typename T::value_type>) {
                append(field.data(), field.size() * sizeof(typename T::value_type));
            } else {
                for (const auto& each : field) put(each);
            }
        } else {
            append(&field, sizeof(T));
        }
    }
    void append(const void* data, std::size_t size) {
        const auto* const octets = static_cast<const std::uint8_t*>(data);
        octets_.insert(octets_.end(), octets, octets + size);
    }
    void put(const std::vector<bool>& field) {
        put(static_cast<std::uint64_t>(field.size()));
        for (const bool each : field) octets_.push_back(each ? 1 : 0);
    }

    Octets octets_;
};

// Adds to a message until it has so many octets on the wire.
class Growth {
public:
    explicit Growth(std::mt19937_64& random) : random_{random} {}

    template <class M>
    void operator()(M& message, std::size_t size) {
        for (std::size_t now = encodedSize(message); now < size; now = encodedSize(message)) {
            add(message, size - now);
        }
    }

private:
    void add(Presence& to, std::size_t left) { to.extras.push_back({text(20), text(left)}); }
    void add(Model& to, std::size_t left) {
        if (random_() % 2 == 0) {
            to.types.emplace_back();
            RandomFields{random_()}(to.types.back());
            to.types.back().description = text(left);
        } else {
            to.simplexes.emplace_back().constants.push_back(values(left));
        }
    }
    void add(Interest& to, std::size_t left) {
        to.views.push_back({static_cast<std::uint32_t>(random_()), {text(30), text(left)}});
    }
    void add(Block& to, std::size_t left) {
        SimplexData& simplex = to.simplexes.emplace_back();
        RandomFields{random_()}(simplex);
        NamedValue values = this->values(left);
        simplex.ints.swap(values.ints);
        simplex.floats.swap(values.floats);
        simplex.bools.swap(values.bools);
        simplex.strings.swap(values.strings);
    }
    void add(Summary& to, std::size_t left) {
        const std::string marks = text(left);
        to.marks.insert(to.marks.end(), marks.begin(), marks.end());
    }
    void add(Command& to, std::size_t left) { to.arguments.push_back(values(left)); }
    void add(Answer& to, std::size_t left) { to.response.push_back(values(left)); }
    void add(EventMessage& to, std::size_t left) {
        to.text = text(left);
        to.extras.push_back({text(20), text(20)});
    }

    void add(PastMessage& to, std::size_t left) {
        RandomFields{random_()}(to.events.emplace_back());
        to.events.back().text = text(left);
        to.kept.push_back({text(20), static_cast<std::int64_t>(random_())});
    }

    NamedValue values(std::size_t left) {
        NamedValue value{text(10), text(10), {}, {}, {}, {}};
        const std::size_t count = left / 8;
        switch (random_() % 4) {
            case 0:
                for (std::size_t i = 0; i < count; ++i)
                    value.ints.push_back(static_cast<std::int64_t>(random_()));
                break;
            case 1:
                for (std::size_t i = 0; i < count; ++i) value.floats.push_back(number());
                break;
            case 2:
                for (std::size_t i = 0; i < left; ++i) value.bools.push_back(random_() % 2 == 0);
                break;
            default:
                value.strings = {text(left / 2), text(left / 2)};
        }
        return value;
    }
    // Any bits, that of what is no number too, and often the octet that Fast DDS looks for.
    double number() {
        const std::uint64_t bits = random_() % 4 == 0 ? 0x8080808080808080 : random_();
        return std::bit_cast<double>(bits);
    }
    // Any octets but 0, at which a text ends; or that octet alone.
    std::string text(std::size_t most) {
        std::string text(random_() % (std::min(most, maxTextLength) + 1), '\x80');
        if (random_() % 4 == 0) return text;
        for (std::size_t i = 0; i < text.size(); i += sizeof(std::uint64_t)) {
            const std::uint64_t octets = random_();
            std::memcpy(&text[i], &octets, std::min(sizeof octets, text.size() - i));
        }
        std::ranges::replace(text, '\0', '\x80');
        return text;
    }

    std::mt19937_64& random_;
};

inline void sign(Presence& message) { message.name = anySender; }
inline void sign(Model& message) { message.agent = anySender; }
inline void sign(Interest& message) { message.name = anySender; }
inline void sign(Block& message) { message.agent = agentId(anySender); }
inline void sign(Summary& message) { message.agent = agentId(anySender); }
inline void sign(Command& message) { message.sender = anySender; }
inline void sign(Answer& message) { message.agent = anySender; }
inline void sign(EventMessage& message) {
    message.agent = agentId(anySender);  // a writer of events has one key
    message.name = anySender;
}

inline void sign(PastMessage& message) { message.name = anySender; }

// A writer of states keeps one message of each key.
inline Id& keyOf(Presence& message) { return message.agent; }
inline Id& keyOf(Model& message) { return message.id; }
inline Id& keyOf(Interest& message) { return message.agent; }
inline Id& keyOf(Block& message) { return message.structureHash; }
inline Id& keyOf(Summary& message) { return message.structureHash; }
inline Id& keyOf(Command& message) { return message.link; }
inline Id& keyOf(Answer& message) { return message.link; }
inline Id& keyOf(EventMessage& message) { return message.agent; }
inline Id& keyOf(PastMessage& message) { return message.agent; }

// A message of 0 to `most` octets, as often of 100 to 1,000 as of 1,000 to 10,000. Beyond 64 kB it
// is about as large as `most` says.
template <class M>
M anyMessage(std::uint64_t seed, std::size_t most) {
    std::mt19937_64 random{seed};
    M message;
    if (random() % 8 != 0) RandomFields{random()}(message);
    RandomFields{random()}(keyOf(message));
    sign(message);
    const double share = std::uniform_real_distribution<double>{}(random);
    const bool large = most > maxInOneDatagram;
    const auto size =
        large ? most : static_cast<std::size_t>(std::pow(static_cast<double>(most), share));
    Growth{random}(message, size);
    return message;
}

}  // namespace cortex::comms
