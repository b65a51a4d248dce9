// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/cell.hpp"
#include "cortex/core/realtime.hpp"
#include "cortex/core/value.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

namespace cortex {

class ProposedSettings;

// What is told of a handle that is used unbound: its class template and what that is made of.
struct HandleWords {
    const char* form;  // "Data"
    Kind kind;
    bool reads;  // of const
};

// Throws UnboundHandle. Apart from the handles, so that their use stays small. `at`: the handle.
[[noreturn]] void throwUnbound(const HandleWords& handle, const void* at = nullptr);

// For messages that are told where a template is used.
template <class>
inline constexpr bool neverTrue = false;

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
    Data& operator=(const Data&)  // NOLINT(bugprone-unhandled-self-assignment): never compiled
        requires(std::is_const_v<T>)
    {
        static_assert(neverTrue<T>,
                      "both handles only read, so '=' has no value to copy to: bind with what "
                      "data<const ...>(\"item\") returns");
        return *this;
    }
    template <class Other>
        requires(!std::is_same_v<Other, T>)
    Data& operator=(Data<Other>&&) & {
        static_assert(neverTrue<Other>,
                      "this cannot bind the handle, as it is of another type: the member of data "
                      "that is only read, such as that of an input, is a Data<const ...>");
        return *this;
    }

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
            throwUnbound({"Data", kindFor<T>(), std::is_const_v<T>}, this);
        return *cell_;
    }

    Storage* cell_ = nullptr;
};

// Handle to an array of strings; its elements are used like the text itself. Empty until it is
// bound. TextArray<const std::string_view> only reads.
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
    CellReference<T> operator[](std::size_t index) const CORTEX_REALTIME {
        if (first_ == nullptr) [[unlikely]]
            throwUnbound({"TextArray", Kind::String, std::is_const_v<T>}, this);
        return CellReference<T>{
            reinterpret_cast<typename StorageOf<T>::type*>(first_ + index * stride_)};
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
