// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

// The folders of keys and signed documents that NetworkOptions::security names. All functions throw
// Error.
namespace cortex::comms {

// The rights of one agent or tool, signed by the authority.
struct AgentRights {
    std::string agent;
    std::vector<std::string> mayCommand{"/"};  // these paths with all below; none: only look
    std::vector<int> domains;                  // none: all
    std::string until;                         // UTC, 2027-11-20T12:00:00Z
    // Hosts whose process may carry it, for versions to come: known, and without effect today.
    std::vector<std::string> carriedBy{};
    // It is linked and commanded only at and below these paths; none: what it has first.
    std::vector<std::string> owns{};
};

inline constexpr int authorityDays = 3650, agentDays = 365;

// Makes the folder with which folders of agents are made: one authority for identities, one for
// permissions. The folder must not exist yet. Nothing is left of it after a failure.
void createAuthority(const std::filesystem::path& folder, int days = authorityDays);

// Makes the folder of one agent or tool with that of the authority. `days` determines `until`, but
// never beyond the end of the authority.
AgentRights createAgent(const std::filesystem::path& authority, const std::filesystem::path& folder,
                        AgentRights rights, int days = agentDays);

// Checks the folder of an agent as a start does. The Error lists everything that is wrong with it.
AgentRights checkSecurity(const std::filesystem::path& folder);

}  // namespace cortex::comms
