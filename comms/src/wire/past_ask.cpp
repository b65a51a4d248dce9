// SPDX-License-Identifier: Apache-2.0
#include "wire/past_ask.hpp"

#include <charconv>

namespace cortex::comms {
namespace {

// A number and the blank behind it.
template <class Number>
bool take(std::string_view& text, Number& number) {
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const auto length = static_cast<std::size_t>(rest - text.data());
    if (error != std::errc{} || length == text.size() || text[length] != ' ') return false;
    text.remove_prefix(length + 1);
    return true;
}

}  // namespace

std::string textOf(const PastAsk& ask) {
    return std::to_string(ask.number) + ' ' + std::to_string(ask.from) + ' ' +
           std::to_string(ask.until) + ' ' + std::to_string(ask.after) + ' ' + ask.agent;
}

std::optional<PastAsk> pastAskFrom(std::string_view text) {
    PastAsk ask;
    const bool holds = take(text, ask.number) && take(text, ask.from) && take(text, ask.until) &&
                       take(text, ask.after);
    if (!holds || ask.number == 0 || text.empty()) return {};
    ask.agent = text;
    return ask;
}

}  // namespace cortex::comms
