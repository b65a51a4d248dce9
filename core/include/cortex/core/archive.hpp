// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/event.hpp"
#include "cortex/core/realtime.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cortex {

class Archive;

// A number, a bool or an enumerator.
template <class T>
concept KeptNumber = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::byte>;
// A struct of the simplex's own, with `void keep(Archive&)`.
template <class T>
concept KeptStruct = requires(T& value, Archive& archive) { value.keep(archive); };

// Where the hook keep() of a simplex hands over its hidden state: numbers, arrays of a fixed
// length, and structs of them. One function serves both directions, so which values are handed
// over, and in which order, must not depend on their content. It neither allocates nor throws.
class Archive {
public:
    enum class Purpose : std::uint8_t {
        Measure,  // how many bytes it will be
        Save,
        Check,  // whether what was saved fits; nothing is changed
        Restore
    };

    // Measures.
    Archive() = default;
    // Saves into `room`. `now`, of this and the next: nominal time of the last cycle, in ns.
    explicit Archive(std::span<std::byte> room, std::int64_t now = 0)
        : purpose_{Purpose::Save}, room_{room}, now_{now} {}
    // Checks or restores what was saved.
    Archive(std::span<const std::byte> saved, Purpose purpose, std::int64_t now = 0)
        : purpose_{purpose}, saved_{saved}, now_{now} {}

    Purpose purpose() const { return purpose_; }
    // Bytes that were handed over so far.
    std::size_t size() const { return size_; }
    // Why something does not fit; from then on nothing is handed over.
    const std::optional<EventText>& problem() const { return problem_; }
    // After keep(): a problem where more was saved than keep() took.
    void finish() CORTEX_REALTIME;

    // First in keep(): the class, and a number that grows with each change of what it keeps. A
    // derived class calls keep() of its base first. Returns the version that was saved, so that a
    // class can still take what an older one kept; a newer one is a problem.
    std::uint16_t version(std::string_view className, std::uint16_t number) CORTEX_REALTIME;

    template <KeptNumber T>
    Archive& operator&(T& value) CORTEX_REALTIME {
        return numbers(&value, 1);
    }
    // A time as Tick::nominalTime, in ns. The clock of another plant shows another time, so what is
    // kept is how long ago it was.
    Archive& time(std::int64_t& value) CORTEX_REALTIME;
    template <KeptStruct T>
    Archive& operator&(T& value) CORTEX_REALTIME {
        value.keep(*this);
        return *this;
    }
    // Its length is fixed before the first cycle; one of another length does not fit.
    template <class T, std::size_t Extent>
    Archive& operator&(std::span<T, Extent> values) CORTEX_REALTIME {
        if constexpr (KeptNumber<T>) return numbers(values.data(), values.size());
        if (!handHead({Field::Structs, 0, 0, static_cast<std::uint32_t>(values.size())}))
            return *this;
        for (T& value : values) *this& value;
        return *this;
    }
    template <class T, std::size_t Length>
    Archive& operator&(std::array<T, Length>& values) CORTEX_REALTIME {
        return *this & std::span<T>{values};
    }
    template <class T>
    Archive& operator&(std::vector<T>& values) CORTEX_REALTIME {
        return *this & std::span<T>{values};
    }

private:
    enum class Field : std::uint8_t { Class = 1, Bool, Int, Unsigned, Float, Byte, Structs };
    struct Head {  // of each field, as it is saved
        Field field;
        std::uint8_t width;  // bytes of an element
        std::uint16_t version = 0;
        std::uint32_t length = 0;
        bool operator==(const Head&) const = default;
    };

    template <class T>
    static constexpr Field fieldOf() {
        if constexpr (std::is_enum_v<T> && !std::is_same_v<T, std::byte>)
            return fieldOf<std::underlying_type_t<T>>();
        else if constexpr (std::is_same_v<T, std::byte>)
            return Field::Byte;
        else if constexpr (std::is_same_v<T, bool>)
            return Field::Bool;
        else if constexpr (std::is_floating_point_v<T>)
            return Field::Float;
        else
            return std::is_signed_v<T> ? Field::Int : Field::Unsigned;
    }
    template <KeptNumber T>
    Archive& numbers(T* values, std::size_t length) CORTEX_REALTIME {
        static_assert(!std::is_const_v<T>, "a constant is no state");
        hand({fieldOf<T>(), sizeof(T), 0, static_cast<std::uint32_t>(length)}, values);
        return *this;
    }
    bool reads() const { return purpose_ == Purpose::Check || purpose_ == Purpose::Restore; }
    // A field is a head, then its elements. False: it does not fit.
    void hand(const Head& head, void* values) CORTEX_REALTIME;
    bool handHead(const Head& head) CORTEX_REALTIME;
    bool handBytes(void* bytes, std::size_t size, bool restores) CORTEX_REALTIME;
    EventText& begin() CORTEX_REALTIME;  // the text of the problem
    static void describe(EventText& text, const Head& head) CORTEX_REALTIME;

    Purpose purpose_ = Purpose::Measure;
    std::span<std::byte> room_;
    std::span<const std::byte> saved_;
    std::size_t size_ = 0;
    std::int64_t now_ = 0;
    std::string_view class_;
    int place_ = 0;  // of the field in its class, from 1
    std::optional<EventText> problem_;
};

}  // namespace cortex
