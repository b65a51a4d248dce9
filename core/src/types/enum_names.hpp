// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/state.hpp"
#include "cortex/core/type_model.hpp"
#include "cortex/core/value.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cortex {

// Spellings of an enumeration in XML and messages, in the order of its enumerators.
template <class E>
inline constexpr std::array<const char*, 0> spellings{};
template <>
inline constexpr std::array spellings<Kind>{"int", "float", "bool", "string"};
template <>
inline constexpr std::array spellings<State>{"Standby", "StartingUp", "Active", "ShuttingDown",
                                             "Fault"};
template <>
inline constexpr std::array spellings<Role>{"descriptive", "observation", "modification", "active"};
template <>
inline constexpr std::array spellings<Direction>{"input", "output"};
template <>
inline constexpr std::array spellings<OnLoss>{"propagate", "hold", "safe", "fault"};
template <>
inline constexpr std::array spellings<OnLimit>{"clamp", "fault"};
template <>
inline constexpr std::array spellings<AtRest>{"safe", "writer"};
template <>
inline constexpr std::array spellings<OnBusy>{"reject", "replace"};
template <>
inline constexpr std::array spellings<OnSenderLost>{"continue", "cancel"};
template <>
inline constexpr std::array spellings<OnInputLost>{"fail", "continue"};
template <>
inline constexpr std::array spellings<OnLeaseLost>{"continue", "hold", "shutdown"};

template <class E>
constexpr const char* spelling(E value) {
    return spellings<E>[static_cast<std::size_t>(value)];
}

template <class E>
std::optional<E> fromSpelling(std::string_view text) {
    for (std::size_t i = 0; i < spellings<E>.size(); ++i) {
        if (text == spellings<E>[i]) return static_cast<E>(i);
    }
    return std::nullopt;
}

// "input or output", for messages.
template <class E>
std::string allSpellings() {
    std::string result;
    for (std::size_t i = 0; i < spellings<E>.size(); ++i) {
        if (i > 0) result += i + 1 < spellings<E>.size() ? ", " : " or ";
        result += spellings<E>[i];
    }
    return result;
}

}  // namespace cortex
