// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/messages.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

// What an agent or a tool adds to its presence, and a sender to its commands, as decimal numbers.
namespace cortex::comms {

inline constexpr const char* agentsHeard = "agents";     // itself included
inline constexpr const char* eventsWritten = "events";   // the number of the last one
inline constexpr const char* uptimeOfAgent = "uptime";   // on the network, in ns
inline constexpr const char* clockOfAgent = "clock";     // ns; not said where the loop is stepped
inline constexpr const char* ageOfLoop = "age";          // ns since its newest cycle ended
inline constexpr const char* standstill = "standstill";  // why the loop stands still, in words
inline constexpr const char* timeStood = "stood";        // ns since it stands still
inline constexpr const char* rateOfLoop = "rate";        // of late, cycles in 1,000 s
inline constexpr const char* overloaded = "overloaded";  // "1"; not said of a loop that keeps up
inline constexpr const char* droppedDatagrams = "dropped";  // by reason, in words
inline constexpr const char* refusedMessages = "refused";   // how many, and why the last, in words
inline constexpr const char* firstOfPairs = "first";        // "one>two": who was there before whom
inline constexpr const char* rootPaths = "roots";           // its topmost paths, or "*"
inline constexpr const char* otherSelf = "other";           // who else speaks in its name, in words
inline constexpr const char* commandsOthers = "commands";   // "1": a tool that may command soon
// Of a tool: who uses it, in words; what it asks holders of control for, "NUMBER PREFIX"; and, once
// for each, an ask of another tool that it refuses, "NUMBER TOOL".
inline constexpr const char* userOfTool = "person";
inline constexpr const char* asksFor = "asks";
inline constexpr const char* refusedAsk = "refuses";
// Of an agent: "1": it can send summaries. Of an interest: "1": its sender wants them.
inline constexpr const char* summaries = "summary";
// Of an agent: "1": it keeps what tools ask for of the past. Of a tool, once for each ask:
// "NUMBER FROM UNTIL AFTER AGENT".
inline constexpr const char* ofThePast = "past";
// Of a sample of a model, for each relationship in it that has a greater age than its rule:
// "PATH RULE TARGET SECONDS".
inline constexpr const char* ageOfRelationship = "maxAge";
// Of the first sample of a model: the signed list of its agent.
inline constexpr const char* signedList = "authority";
inline constexpr const char* validUntil = "until";  // of a command, by the clock of its target
// Of a command: who is behind it, and what its sender knows it by. The answer says both again.
inline constexpr const char* onBehalfOf = "onBehalfOf";
inline constexpr const char* correlation = "correlation";
// Of an event: its number among those that the same input causes again; 0: from measured times.
inline constexpr const char* repeatable = "repeatable";

// Empty: the message does not say so.
template <class Message>
std::string textIn(const Message& message, std::string_view name) {
    for (const Extra& extra : message.extras) {
        if (extra.name == name) return extra.value;
    }
    return {};
}

// 0: the message does not say so.
template <class Message>
std::uint64_t numberIn(const Message& message, std::string_view name) {
    std::uint64_t number = 0;
    for (const Extra& extra : message.extras) {
        if (extra.name != name) continue;
        std::from_chars(extra.value.data(), extra.value.data() + extra.value.size(), number);
    }
    return number;
}

// The same of a time in ns, so bounded that no sum with it overflows.
template <class Message>
std::int64_t timeIn(const Message& message, std::string_view name) {
    constexpr std::uint64_t longest = std::uint64_t{1} << 61U;
    return static_cast<std::int64_t>(std::min(numberIn(message, name), longest));
}

}  // namespace cortex::comms
