// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace cortex {

// Between a number and a text that came so often: "4 times within a second: clamped to 2.5 rad".
constexpr std::string_view timesWithinASecond = " times within a second: ";
// The text alone. Any other one as it is.
std::string_view withoutTimes(std::string_view text);

// What an event of kind `command`, `control` or `refusal` says of a command that came from outside,
// taken apart: "operator@desk: jog(speed=0.5): Done in 2 cycles". The text of an event is bounded:
// parts that were cut off are empty. Agents write it in Router::report().
struct CommandSentence {
    std::string_view sender;   // "operator@desk", "cortex@desk.4711-5e1f0a for Ada"
    std::string_view command;  // "jog"
    std::string_view
        arguments;             // "speed=0.5"; what is left of them ends in "…" where they were cut
    std::string_view outcome;  // "Done", "Rejected (range), speed is above 1 rad/s"
    std::string_view latency;  // "2 cycles", "the same cycle"
    bool done = false;         // the outcome is Done
};

// None: the text says no such thing.
std::optional<CommandSentence> commandSentence(std::string_view text);

}  // namespace cortex
