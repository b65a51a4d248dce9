// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/security.hpp"

#include <ctime>
#include <optional>
#include <string>
#include <string_view>

// The texts that an authority signs.
namespace cortex::comms {

std::string governance();                            // for all agents: everything encrypted
std::string permissions(const AgentRights& rights);  // for one, in the words of DDS-Security

// Rights and public key of one agent, by which a receiver judges its commands.
struct CommandList {
    AgentRights rights;
    std::string key;
};
std::string textOf(const CommandList& list);
std::optional<CommandList> commandListFrom(std::string_view text);

std::string utcText(std::time_t time);  // 2027-11-20T12:00:00Z
std::optional<std::time_t> utcFrom(const std::string& text);
// Whether its list names the path, or one above it, as its own.
bool ownsPath(const AgentRights& rights, std::string_view path);
// Whether the agent may command what is at `path`; if not, `why` has the reason.
bool mayCommand(const AgentRights& rights, std::string_view path, std::string& why);

}  // namespace cortex::comms
