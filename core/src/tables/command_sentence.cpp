// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/command_sentence.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace cortex {
namespace {

constexpr std::string_view between = ": ", closed = "): ", in = " in ";

bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Where ": name(" begins; npos: nowhere.
std::size_t findCommand(std::string_view text) {
    for (std::size_t at = text.find(between); at != std::string_view::npos;
         at = text.find(between, at + 1)) {
        std::size_t end = at + between.size();
        while (end < text.size() && isOfName(text[end])) ++end;
        if (at > 0 && end > at + between.size() && end < text.size() && text[end] == '(') return at;
    }
    return std::string_view::npos;
}

// "Done" of "Done in 2 cycles". Outcomes are words with a capital letter.
std::string_view outcomeIn(std::string_view text) {
    const auto end = std::ranges::find_if_not(text, isOfName);
    const bool is = !text.empty() && std::isupper(static_cast<unsigned char>(text.front())) != 0;
    return is ? text.substr(0, static_cast<std::size_t>(end - text.begin())) : std::string_view{};
}

// The ")" before the outcome: a text among the arguments may have one, too.
std::size_t findEnd(std::string_view text) {
    std::size_t at = text.rfind(closed);
    while (at != std::string_view::npos && outcomeIn(text.substr(at + closed.size())).empty()) {
        at = at == 0 ? std::string_view::npos : text.rfind(closed, at - 1);
    }
    return at;
}

// "in 2 cycles" at the end of what became of it.
void takeLatency(CommandSentence& sentence) {
    const std::size_t at = sentence.outcome.rfind(in);
    if (at == std::string_view::npos) return;
    const std::string_view latency = sentence.outcome.substr(at + in.size());
    if (!latency.ends_with("cycle") && !latency.ends_with("cycles")) return;
    sentence.latency = latency;
    sentence.outcome = sentence.outcome.substr(0, at);
}

}  // namespace

std::string_view withoutTimes(std::string_view text) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    const bool counts = digits > 0 && text.substr(digits).starts_with(timesWithinASecond);
    return counts ? text.substr(digits + timesWithinASecond.size()) : text;
}

std::optional<CommandSentence> commandSentence(std::string_view text) {
    text = withoutTimes(text);
    const std::size_t name = findCommand(text);
    if (name == std::string_view::npos) return std::nullopt;
    CommandSentence sentence;
    sentence.sender = text.substr(0, name);
    std::string_view rest = text.substr(name + between.size());
    const std::size_t open = rest.find('(');
    sentence.command = rest.substr(0, open);
    rest = rest.substr(open + 1);
    const std::size_t end = findEnd(rest);
    sentence.arguments = rest.substr(0, end);
    if (end == std::string_view::npos) return sentence;
    sentence.outcome = rest.substr(end + closed.size());
    sentence.done = outcomeIn(sentence.outcome) == "Done";
    takeLatency(sentence);
    return sentence;
}

}  // namespace cortex
