// SPDX-License-Identifier: Apache-2.0
#include "dds/security_guard.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace cortex::comms {
namespace {

namespace fastrtps = eprosima::fastrtps::rtps;
constexpr std::size_t mostFound = 4'096;
constexpr std::size_t longestName = 64;  // of a foreign name in an event
constexpr std::chrono::seconds usualHandshake{2}, longestHandshake{5};

std::string calledItself(const std::string& name) {
    return name.empty() ? "" : " that calls itself " + name;
}

}  // namespace

void SecurityGuard::refuse(std::string_view name) {
    ++refused_;
    refusals_.add("a participant uses the name " + std::string{name.substr(0, longestName)} +
                  ", and its certificate is that of another: refused");
}

void SecurityGuard::refuse(const Id&) {
    ++refused_;
    refusals_.add("a participant sends values in the name of another: refused");
}

void SecurityGuard::on_participant_discovery(Dds*, fastrtps::ParticipantDiscoveryInfo&& info) {
    count(info);
    using Info = fastrtps::ParticipantDiscoveryInfo;
    const std::lock_guard lock{mutex_};
    if (info.status == Info::DISCOVERED_PARTICIPANT) {
        if (found_.size() >= mostFound) found_.clear();
        found_.try_emplace(info.info.m_guid).first->second.name =
            std::string_view{info.info.m_participantName.c_str()}.substr(0, longestName);
    } else if (info.status != Info::CHANGED_QOS_PARTICIPANT) {
        found_.erase(info.info.m_guid);
    }
}

void SecurityGuard::onParticipantAuthentication(Dds*,
                                                fastrtps::ParticipantAuthenticationInfo&& info) {
    const bool isProven =
        info.status == fastrtps::ParticipantAuthenticationInfo::AUTHORIZED_PARTICIPANT;
    std::string name;
    {
        const std::lock_guard lock{mutex_};
        if (const auto known = found_.find(info.guid); known != found_.end()) {
            known->second.pending = false;
            known->second.refused = !isProven;
            name = known->second.name;
        }
        if (isProven) {
            if (proven_.size() >= mostFound) {
                std::erase_if(proven_, [&](const Guid& each) { return !found_.contains(each); });
            }
            proven_.insert(info.guid);
        }
    }
    if (isProven) return;
    ++refused_;
    refusals_.add("a participant" + calledItself(name) +
                  " is refused: it has no certificate of our authority");
}

// An authenticated participant first exchanges keys and endpoints, so its first sample comes later.
std::uint32_t SecurityGuard::pending() {
    const std::lock_guard lock{mutex_};
    const auto now = Clock::now();
    return static_cast<std::uint32_t>(std::ranges::count_if(found_, [&](const auto& each) {
        GuidPrefix participant{};
        std::copy_n(each.first.guidPrefix.value, participant.size(), participant.begin());
        return !each.second.refused && now - each.second.since < usualHandshake &&
               !identity_.hasSpoken(participant);
    }));
}

bool SecurityGuard::findsUnproven() {
    const std::lock_guard lock{mutex_};
    const auto now = Clock::now();
    return std::ranges::any_of(found_, [&](const auto& each) {
        const bool mayKnowUs = proven_.empty() || proven_.contains(each.first);
        return mayKnowUs && each.second.pending && now - each.second.since >= longestHandshake;
    });
}

// A participant that refuses our certificate does not show its own. All that can be seen is that
// the handshake does not end.
std::vector<std::string> SecurityGuard::takeRefusals() {
    {
        const std::lock_guard lock{mutex_};
        const auto now = Clock::now();
        for (auto& [guid, found] : found_) {
            if (!found.pending || found.reported || now - found.since < longestHandshake) continue;
            found.reported = true;
            ++refused_;
            refusals_.add("a participant" + calledItself(found.name) +
                          " is refused: it does not prove that it has a certificate");
        }
    }
    return refusals_.take();
}

void addSecurity(const std::string& folder, eprosima::fastdds::dds::DomainParticipantQos& qos) {
    namespace files = security_files;
    const std::string path = "file://" + std::filesystem::absolute(folder).string() + "/";
    const std::string auth = "dds.sec.auth.builtin.PKI-DH.",
                      access = "dds.sec.access.builtin.Access-Permissions.";
    auto& properties = qos.properties().properties();
    const auto add = [&](const std::string& name, const std::string& value) {
        properties.emplace_back(name, value);
    };
    add("dds.sec.auth.plugin", "builtin.PKI-DH");
    add(auth + "identity_ca", path + files::identityAuthority);
    add(auth + "identity_certificate", path + files::certificate);
    add(auth + "private_key", path + files::key);
    add("dds.sec.access.plugin", "builtin.Access-Permissions");
    add(access + "permissions_ca", path + files::permissionsAuthority);
    add(access + "governance", path + files::governance);
    add(access + "permissions", path + files::permissions);
    add("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace cortex::comms
