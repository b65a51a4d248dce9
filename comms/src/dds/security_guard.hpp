// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/discovery_counter.hpp"
#include "dds/security_refusals.hpp"
#include "security/security_identity.hpp"
#include "wire/messages.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/rtps/common/Guid.h>

namespace cortex::comms {

inline const std::string& claimedName(const Presence& sample) { return sample.name; }
inline const std::string& claimedName(const Model& sample) { return sample.agent; }
inline const std::string& claimedName(const Interest& sample) { return sample.name; }
inline const Id& claimedName(const Block& sample) { return sample.agent; }
inline const Id& claimedName(const Summary& sample) { return sample.agent; }
inline const std::string& claimedName(const Command& sample) { return sample.sender; }
inline const std::string& claimedName(const Answer& sample) { return sample.agent; }
inline const std::string& claimedName(const EventMessage& sample) { return sample.name; }
inline const std::string& claimedName(const PastMessage& sample) { return sample.name; }

// Guards a participant with security: asks Fast DDS for security, notices participants that Fast
// DDS refused, and refuses samples whose name is not that of their sender. Any thread.
class SecurityGuard final : public DiscoveryCounter {
    using Dds = eprosima::fastdds::dds::DomainParticipant;

public:
    // Throws Error as SecurityIdentity.
    SecurityGuard(const std::string& folder, const std::string& name, int domain)
        : identity_{folder, name, domain} {}

    SecurityIdentity& identity() { return identity_; }
    // What was refused since the last call, as sentences.
    std::vector<std::string> takeRefusals();
    std::uint64_t refused() const { return refused_; }
    // The number of participants that were found recently, are not refused, and have not sent a
    // name yet.
    std::uint32_t pending();
    // Whether one was found that has not proven for 5 s who it is, though it did before: it knows
    // us and answers no second handshake. A stranger, or one whose first handshake takes long, only
    // counts as long as nobody has proven anything.
    bool findsUnproven();

    // A claim is a name or the id of a name.
    template <class Claim>
    bool admits(const eprosima::fastrtps::rtps::InstanceHandle_t& writer, const Claim& claim) {
        GuidPrefix participant{};
        for (std::size_t i = 0; i < participant.size(); ++i) participant[i] = writer.value[i];
        if (identity_.maySpeakFor(participant, claim)) return true;
        const bool early = std::is_same_v<Claim, Id> && !identity_.hasSpoken(participant);
        if (!early) refuse(claim);  // otherwise its name may still come
        return false;
    }

    void on_participant_discovery(
        Dds* participant, eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
    void onParticipantAuthentication(
        Dds* participant, eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override;

private:
    void refuse(std::string_view name);
    void refuse(const Id& agent);

    SecurityIdentity identity_;
    Refusals refusals_;
    std::atomic<std::uint64_t> refused_{0};
    using Clock = std::chrono::steady_clock;
    struct Found {
        std::string name;  // as it calls itself; not proven
        Clock::time_point since = Clock::now();
        bool pending = true, refused = false, reported = false;
    };
    std::mutex mutex_;
    std::map<Guid, Found> found_;
    std::set<Guid> proven_;  // also those that have gone, as they may come back
};

// Asks Fast DDS for authentication, access control and encryption with the files of the folder.
void addSecurity(const std::string& folder, eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace cortex::comms
