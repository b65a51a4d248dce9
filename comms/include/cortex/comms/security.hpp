// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

// The folders of keys and signed papers that NetworkOptions::security names. All throw Error.
namespace cortex::comms {

// What a folder says of its owner, signed by the authority.
struct AgentRights {
    std::string agent;
    std::vector<std::string> mayCommand{"/"};  // these paths with all below; none: only look
    std::vector<int> domains;                  // none: all
    std::string until;                         // UTC, 2027-11-20T12:00:00Z
};

inline constexpr int AuthorityDays = 3650, AgentDays = 365;

// The folder with which folders of agents are made: an authority for identities, one for
// permissions. Must not exist yet; nothing is left of it if that fails.
void createAuthority(const std::filesystem::path& folder, int days = AuthorityDays);

// The folder of one agent or tool, made with that of the authority. `until` is said by `days`, but
// not beyond the authority's end.
AgentRights createAgent(const std::filesystem::path& authority, const std::filesystem::path& folder,
                        AgentRights rights, int days = AgentDays);

// Checks the folder of an agent as a start does; the Error says everything that is wrong with it.
AgentRights checkSecurity(const std::filesystem::path& folder);

}  // namespace cortex::comms
