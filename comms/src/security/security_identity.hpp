// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "security/security_documents.hpp"
#include "security/security_folder.hpp"
#include "wire/messages.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

using GuidPrefix = std::array<std::uint8_t, 12>;  // of a participant

inline constexpr const char* securityOn = "authenticated, encrypted";  // in a presence

// The name in its certificate: "station" for the tool "station@desk.42".
std::string_view certifiedName(std::string_view name);

// Who a participant is and how it knows others, where security is on. Any thread.
//
// DDS-Security authenticates participants; 47 bits of the id of each are those of the digest of its
// certificate's subject, which tells whether it may use a name. A command proves more: it carries
// the list of what its sender may command, signed by the permissions authority, and a signature
// with the key that this list names.
class SecurityIdentity {
public:
    // Throws Error if the folder cannot be used, or belongs to another agent, tool or domain.
    SecurityIdentity(const std::string& folder, const std::string& name, int domain);

    const SecurityFolder& folder() const { return folder_; }

    bool maySpeakFor(const GuidPrefix& participant, std::string_view name);
    // The same for the id of a name. It is known only after a sample with the name itself.
    bool maySpeakFor(const GuidPrefix& participant, const Id& agent);
    bool hasSpoken(const GuidPrefix& participant);

    void sign(Command& command) const;
    // What the list of the sender permits. Null: the command does not prove who sent it; `why` has
    // the reason.
    std::shared_ptr<const AgentRights> rightsOf(const Command& command, std::string& why);

    // The rights on the signed list that an agent shows with its model, whose sender is
    // authenticated. Null: it shows none, or one of another agent, domain or time.
    std::shared_ptr<const AgentRights> shownBy(std::string_view agent, const std::string& smime);

private:
    using Lists = std::map<std::string, std::shared_ptr<const CommandList>>;
    std::shared_ptr<const CommandList> listOf(const std::string& smime);

    SecurityFolder folder_;
    const int domain_;
    std::mutex mutex_;
    std::map<GuidPrefix, std::map<std::string, Id, std::less<>>> speakers_;
    Lists lists_;  // those that were verified, by their text
};

}  // namespace cortex::comms
