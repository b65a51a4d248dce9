// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"
#include "cortex/core/value.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace cortex {

class ProposedSettings;

// Octets of `text` that fit into `capacity` without splitting a UTF-8 character.
std::size_t fittingLength(std::string_view text, std::size_t capacity) CORTEX_REALTIME;

// How often a text in any table has changed. Images copy texts only where it has moved: texts are
// usually more than half of the bytes and change least. Whoever writes the cells of a text by other
// means than assign() counts it here, after writing. Any thread.
std::uint64_t textChanges() CORTEX_REALTIME;
void countTextChange() CORTEX_REALTIME;

// Head of a string element in a table; `capacity` bytes of UTF-8 follow it.
struct StringCell {
    std::uint16_t capacity;
    std::uint16_t length;
    std::uint32_t cuts;  // how often a text was too long

    char* text() { return reinterpret_cast<char*>(this + 1); }
    const char* text() const { return reinterpret_cast<const char*>(this + 1); }
    std::string_view view() const { return {text(), length}; }
    void assign(std::string_view value) CORTEX_REALTIME;  // cut at a character if too long; counted

    // Octets that a cell of this capacity takes in a table, a multiple of 8.
    static constexpr std::uint32_t size(std::uint32_t capacity) {
        return static_cast<std::uint32_t>(sizeof(StringCell) + capacity + 7U) / 8U * 8U;
    }
};

template <class T>
struct StorageOf {
    using type = T;
};
template <>
struct StorageOf<std::string_view> {
    using type = StringCell;
};
template <class T>
struct StorageOf<const T> {
    using type = const typename StorageOf<T>::type;
};

template <class T>
constexpr Kind kindFor() {
    using Plain = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Plain, std::int64_t>)
        return Kind::Int;
    else if constexpr (std::is_same_v<Plain, double>)
        return Kind::Float;
    else if constexpr (std::is_same_v<Plain, bool>)
        return Kind::Bool;
    else {
        static_assert(std::is_same_v<Plain, std::string_view>,
                      "data is std::int64_t, double, bool or std::string_view");
        return Kind::String;
    }
}

// What arrays consist of as spans; those of strings are a TextArray.
template <class T>
concept ArrayElement = !std::is_same_v<std::remove_const_t<T>, std::string_view>;

// Data that is counted up or scaled where it lies.
template <class T>
concept NumberCell = std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>;

// Throws UnboundHandle. Apart from the handles, so that their use stays small.
[[noreturn]] void throwUnbound(Kind kind);

// Handle to one scalar item: a plain pointer into the tables, used like the value itself.
// Data<const T> only reads. Got in populate(), used in ticks; unbound until then. Using an unbound
// one throws UnboundHandle, which puts the simplex of the hook into Fault.
//
// Only what data() and its like return binds a handle: `level_ = data<double>("level")`. Assigning
// a handle that has a name copies the value: `level_ = other_` is `level_ = other_.get()`.
template <class T>
class Data {
public:
    using Storage = typename StorageOf<T>::type;
    using Plain = std::remove_const_t<T>;

    Data() = default;
    explicit Data(Storage* cell) : cell_{cell} {}
    ~Data() = default;
    Data(const Data&) = default;
    Data(Data&&) noexcept = default;

    Data& operator=(Data&& bound) & noexcept = default;  // binds what has a name
    Data& operator=(const Data& other) CORTEX_REALTIME
        requires(!std::is_const_v<T>)
    {
        return this == &other ? *this : *this = other.get();
    }
    Data& operator=(const Data&)
        requires(std::is_const_v<T>)
    = delete;
    // A handle of another kind, or one that only reads, cannot be bound here.
    template <class Other>
        requires(!std::is_same_v<Other, T>)
    Data& operator=(Data<Other>&&) & = delete;

    operator Plain() const CORTEX_REALTIME { return get(); }
    Plain get() const CORTEX_REALTIME {
        if constexpr (std::is_same_v<Plain, std::string_view>)
            return cell().view();
        else
            return cell();
    }
    Data& operator=(Plain value) CORTEX_REALTIME
        requires(!std::is_const_v<T>)
    {
        if constexpr (std::is_same_v<Plain, std::string_view>)
            cell().assign(value);
        else
            cell() = value;
        return *this;
    }
    Data& operator+=(Plain value) CORTEX_REALTIME
        requires NumberCell<T>
    {
        cell() += value;
        return *this;
    }
    Data& operator-=(Plain value) CORTEX_REALTIME
        requires NumberCell<T>
    {
        cell() -= value;
        return *this;
    }
    Data& operator*=(Plain value) CORTEX_REALTIME
        requires NumberCell<T>
    {
        cell() *= value;
        return *this;
    }
    Data& operator/=(Plain value) CORTEX_REALTIME
        requires NumberCell<T>
    {
        cell() /= value;
        return *this;
    }
    explicit operator bool() const
        requires(!std::is_same_v<Plain, bool> && !std::is_arithmetic_v<Plain>)
    = delete;

    bool bound() const { return cell_ != nullptr; }

private:
    friend class ProposedSettings;  // finds the item of a handle

    Storage& cell() const CORTEX_REALTIME {
        if (cell_ == nullptr) [[unlikely]]
            throwUnbound(kindFor<T>());
        return *cell_;
    }

    Storage* cell_ = nullptr;
};

// Handle to an array of strings; its elements are used like Data. Empty until it is bound.
// TextArray<const std::string_view> only reads.
template <class T>
class TextArray {
public:
    TextArray() = default;
    TextArray(typename StorageOf<T>::type* first, std::size_t length)
        : first_{reinterpret_cast<Byte*>(first)}, length_{length} {
        if (length_ != 0) stride_ = StringCell::size(first->capacity);
    }

    std::size_t size() const { return length_; }
    // `index` is less than size().
    Data<T> operator[](std::size_t index) const CORTEX_REALTIME {
        if (first_ == nullptr) [[unlikely]]
            throwUnbound(Kind::String);
        return Data<T>{reinterpret_cast<typename StorageOf<T>::type*>(first_ + index * stride_)};
    }
    bool bound() const { return first_ != nullptr; }

private:
    using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;

    Byte* first_ = nullptr;
    std::size_t length_ = 0, stride_ = 0;
};

// What array<T>() returns: a span, or a TextArray of strings.
template <class T>
struct ArrayOf {
    using type = std::span<T>;
};
template <class T>
    requires(!ArrayElement<T>)
struct ArrayOf<T> {
    using type = TextArray<T>;
};

}  // namespace cortex
