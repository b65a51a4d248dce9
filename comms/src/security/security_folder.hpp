// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/security.hpp"

#include "security/security_openssl.hpp"

#include <filesystem>
#include <string>

namespace cortex::comms {

namespace security_files {
inline constexpr const char *identityAuthority = "identity_ca.pem",
                            *identityAuthorityKey = "identity_ca.key.pem",
                            *permissionsAuthority = "permissions_ca.pem",
                            *permissionsAuthorityKey = "permissions_ca.key.pem",
                            *certificate = "certificate.pem", *key = "key.pem",
                            *governance = "governance.smime", *permissions = "permissions.smime",
                            *commands = "commands.smime";
}  // namespace security_files

// The contents of the folder of an agent, read and checked.
struct SecurityFolder {
    // Throws Error that lists everything that is wrong, with the remedy.
    explicit SecurityFolder(const std::filesystem::path& folder);

    std::filesystem::path folder;  // absolute
    AgentRights rights;
    Certificate permissionsAuthority;
    Key key;
    std::string commands;  // the signed list
};

// Why somebody else can change it, with the remedy: its mode, or its owner, who is neither this
// program's user nor root. "" if nobody can.
std::string changeableByOthers(const std::filesystem::path& path);

// Throws Error if it cannot be read.
std::string contentOf(const std::filesystem::path& file);

}  // namespace cortex::comms
