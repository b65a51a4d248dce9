// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"
#include "cortex/core/value.hpp"

#include <cstddef>
#include <cstdint>
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

// A cell that a call or an array of strings shows, used like the value itself. It is no handle:
// `wanted_ = call[speed_]` copies the value.
template <class T>
class CellReference {
public:
    using Storage = typename StorageOf<T>::type;
    using Plain = std::remove_const_t<T>;

    explicit CellReference(Storage* cell) : cell_{cell} {}
    ~CellReference() = default;
    CellReference(const CellReference&) = default;
    CellReference(CellReference&&) noexcept = default;

    operator Plain() const CORTEX_REALTIME { return get(); }
    Plain get() const CORTEX_REALTIME {
        if constexpr (ArrayElement<T>)
            return *cell_;
        else
            return cell_->view();
    }
    CellReference& operator=(Plain value) CORTEX_REALTIME
        requires(!std::is_const_v<T>)
    {
        if constexpr (ArrayElement<T>)
            *cell_ = value;
        else
            cell_->assign(value);
        return *this;
    }
    CellReference& operator=(const CellReference& other) CORTEX_REALTIME
        requires(!std::is_const_v<T>)
    {
        if (this != &other) *this = other.get();
        return *this;
    }
    CellReference& operator+=(Plain value) CORTEX_REALTIME
        requires NumberCell<T>
    {
        return *this = get() + value;
    }

private:
    friend class ProposedSettings;  // finds the item of a cell

    Storage* cell_;
};

}  // namespace cortex
