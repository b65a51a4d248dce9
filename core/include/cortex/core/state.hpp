// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cortex {

// States of an active simplex; the numbers are those of the data item `state` in base.xml.
enum class State : std::uint8_t { Standby, StartingUp, Active, ShuttingDown, Fault };

inline constexpr int stateCount = 5;

const char* name(State state);
std::optional<State> stateFromName(std::string_view text);

// A set of states: where a command is available, or an item may be set.
class StateSet {
public:
    constexpr StateSet() = default;

    static constexpr StateSet none() { return StateSet{}; }
    static constexpr StateSet always() { return StateSet{(1U << stateCount) - 1U}; }
    static constexpr StateSet of(State state) {
        return StateSet{1U << static_cast<unsigned>(state)};
    }

    constexpr bool has(State state) const { return (bits_ & of(state).bits_) != 0; }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr bool contains(StateSet other) const { return (other.bits_ & ~bits_) == 0; }
    constexpr StateSet operator|(StateSet other) const { return StateSet{bits_ | other.bits_}; }
    constexpr StateSet operator&(StateSet other) const { return StateSet{bits_ & other.bits_}; }
    constexpr bool operator==(const StateSet&) const = default;

    std::string text() const;  // "Standby Active", "always", or ""

private:
    constexpr explicit StateSet(unsigned bits) : bits_{bits} {}
    unsigned bits_ = 0;
};

// Blank-separated state names, or "always".
std::optional<StateSet> stateSetFromText(std::string_view text);

}  // namespace cortex
