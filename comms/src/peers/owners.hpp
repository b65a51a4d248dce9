// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/security.hpp"
#include "cortex/core/structure.hpp"

#include "wire/messages.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Who owns a path that several agents have: the one with the higher right, otherwise the one that
// was there first. It alone executes commands to the path, is linked and is shown. No wall clock
// decides anything. All times are ns of the listener's monotonic clock.
namespace cortex::comms {

inline constexpr std::int64_t longAlone = 20'000'000'000;
inline constexpr std::int64_t nearlyAtOnce = 500'000'000;  // between two starts

// Names of agents: the first was there before the second.
using AgentPair = std::pair<std::string, std::string>;
using AgentPairs = std::vector<AgentPair>;

// As an agent says them in its presence, "one>two one>three", at most 8. What is malformed is left
// out.
std::string textOf(const AgentPairs& pairs);
AgentPairs pairsFrom(std::string_view text);

// The topmost of an agent's own paths with blanks between, as its presence says them; "*" where
// they are too long.
std::string rootsOf(const Structure& structure);
// Whether an agent with these roots may have the path. One that says none may have any.
bool mayHave(std::string_view roots, std::string_view path);
// Whether two agents with these roots may have a path in common.
bool mayShare(std::string_view some, std::string_view others);

// The right to a path. A higher one wins however late its agent comes.
enum class Rank {
    None,   // its signed list names other paths as its own
    Least,  // security is on, and its list permits no command or was not shown
    Equal,  // without security; or it may command something
    Owns,   // its signed list names the path
    Named   // it is the agent NAME of /NAME and all below
};
// `rights`: null without security, and where the list was not shown.
Rank rankOf(std::string_view agent, std::string_view path, bool secured, const AgentRights* rights);

// Throws Error unless the rights cover all own paths of the structure, where they name any.
void requireOwned(const Structure& structure, const AgentRights& rights);

// What somebody heard of one start of an agent.
struct Seniority {
    // False: nothing has changed that may decide.
    bool take(const Presence& presence, std::int64_t now);
    bool saysFirst(std::string_view one, std::string_view other) const;

    std::int64_t heard = 0;  // first; 0: not yet
    std::int64_t began = 0;  // the earliest time at which it can have begun
    AgentPairs says;
};

// An agent that has the path in question.
struct Claimant {
    std::string agent;
    Rank rank = Rank::Equal;
    Seniority seniority;
    bool lost = false;
};

// Whether one was there before the other, for a listener that began at this time: by a word of one
// against itself, by the listener's own ears, by how long they run, by name.
bool wasFirst(const Claimant& one, const Claimant& other, std::int64_t began);

using WasFirst = std::function<bool(const Claimant& one, const Claimant& other)>;
// The place of the owner. None: nobody has a right to the path.
std::optional<std::size_t> ownerAmong(std::span<const Claimant> claimants,
                                      const WasFirst& wasFirst);

// Why this one is it, as the end of a sentence: "which was there first".
std::string ownerReason(std::span<const Claimant> claimants, std::size_t owner, std::int64_t began);

// The one sentence that all tools say: "agents one, two both have /arm; commands go to one, which
// was there first". For a single agent without a right to the path it says so.
std::string ownerText(std::string_view path, std::span<const Claimant> claimants,
                      std::int64_t began);

}  // namespace cortex::comms
