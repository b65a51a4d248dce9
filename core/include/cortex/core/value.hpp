// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace cortex {

// The four kinds of data; an item is one element or an array of one kind.
enum class Kind : std::uint8_t { Int, Float, Bool, String };

const char* name(Kind kind);  // "int", "float", "bool", "string": as in XML
std::optional<Kind> kindFromName(std::string_view text);

// A value outside the tables (defaults, settings, readings): always a list, a scalar has one
// element. The alternative's index is the Kind.
using Value = std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<bool>,
                           std::vector<std::string>>;

// A value as code gives it: a Value, a vector of elements (or array, or span), or one element (0.5,
// 3, true, "text").
class GivenValue {
public:
    template <class T>
    GivenValue(const T& given) : value_{valueOf(given)} {}

    operator const Value&() const { return value_; }

private:
    template <class T>
    static Value valueOf(const T& given) {
        if constexpr (std::is_same_v<T, bool>)
            return std::vector<bool>{given};
        else if constexpr (std::is_integral_v<T>)
            return std::vector<std::int64_t>{static_cast<std::int64_t>(given)};
        else if constexpr (std::is_floating_point_v<T>)
            return std::vector<double>{static_cast<double>(given)};
        else if constexpr (std::is_convertible_v<const T&, std::string_view>)
            return std::vector<std::string>{std::string{std::string_view{given}}};
        else if constexpr (requires { requires std::is_integral_v<typename T::value_type>; } &&
                           !std::is_same_v<T, std::vector<bool>>)
            return std::vector<std::int64_t>(given.begin(), given.end());
        else if constexpr (requires { requires std::is_floating_point_v<typename T::value_type>; })
            return std::vector<double>(given.begin(), given.end());
        else
            return Value{given};
    }

    Value value_;
};

Kind kindOf(const Value& value);
std::size_t lengthOf(const Value& value);

// One bound of a range, exact for either numeric kind.
using Number = std::variant<std::int64_t, double>;

// Numbers as text: the same in every locale; a double has the shortest form that reads back equal.
std::string toText(std::int64_t number);
std::string toText(double number);
std::string toText(const Number& number);
std::string toText(const Value& value);  // blank-separated; strings with blanks are quoted

// The whole of `text` must be a number; hex, "inf" and "nan" are refused. No exceptions.
std::optional<std::int64_t> toInt(std::string_view text);
std::optional<double> toFloat(std::string_view text);
std::optional<bool> toBool(std::string_view text);  // "true" or "false"

// Reads `length` blank-separated elements (a single string takes the whole text). On failure the
// result is empty and `why` says what was expected and what was found.
std::optional<Value> parseValue(Kind kind, std::size_t length, std::string_view text,
                                std::string& why);

}  // namespace cortex
