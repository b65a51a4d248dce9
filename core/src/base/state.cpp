// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/state.hpp"

#include "base/text.hpp"

namespace cortex {

std::string StateSet::text() const {
    if (*this == always()) return "always";
    std::string result;
    for (int i = 0; i < stateCount; ++i) {
        const auto state = static_cast<State>(i);
        if (!has(state)) continue;
        if (!result.empty()) result += ' ';
        result += name(state);
    }
    return result;
}

std::optional<StateSet> stateSetFromText(std::string_view text) {
    const auto words = splitBlanks(text);
    if (words.size() == 1 && words.front() == "always") return StateSet::always();
    StateSet result;
    for (const std::string_view word : words) {
        const auto state = stateFromName(word);
        if (!state) return std::nullopt;
        result = result | StateSet::of(*state);
    }
    if (result.empty()) return std::nullopt;
    return result;
}

}  // namespace cortex
