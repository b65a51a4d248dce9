// SPDX-License-Identifier: Apache-2.0
#include "security/security_identity.hpp"

#include "cortex/core/error.hpp"

#include "wire/cdr.hpp"
#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::size_t mostParticipants = 4'096, mostNames = 16, mostLists = 1'024;
constexpr const char* signatureExtra = "signature";

const std::string* extraOf(const Command& command, const char* name) {
    const auto found = std::ranges::find(command.extras, name, &Extra::name);
    return found != command.extras.end() ? &found->value : nullptr;
}

// The signed text is the encoded command without the signature.
Octets signedOctets(Command command) {
    std::erase_if(command.extras, [](const Extra& each) { return each.name == signatureExtra; });
    Octets octets(encodedSize(command));
    octets.resize(encode(command, octets));
    return octets;
}

// The first bit of the id is 1, the next 47 are those of the digest.
bool belongsTo(const GuidPrefix& participant, const std::string& name) {
    const auto digest = subjectDigest(name);
    unsigned carried = 1;
    for (std::size_t i = 0; i < 6; ++i) {
        const unsigned expected = (carried << 7U | digest[i] >> 1U) & 0xFFU;
        if (participant[i] != expected) return false;
        carried = digest[i] & 1U;
    }
    return true;
}

}  // namespace

std::string_view certifiedName(std::string_view name) { return name.substr(0, name.find('@')); }

SecurityIdentity::SecurityIdentity(const std::string& folder, const std::string& name, int domain)
    : folder_{folder}, domain_{domain} {
    const AgentRights& rights = folder_.rights;
    const std::string made = "the security folder '" + folder_.folder.string() + "' is made for ";
    if (certifiedName(name) != rights.agent) {
        throw Error{made + "'" + rights.agent + "' and not for '" + name +
                    "'; make one: cortex security create-agent " +
                    std::string{certifiedName(name)}};
    }
    if (!rights.domains.empty() && std::ranges::count(rights.domains, domain) == 0) {
        std::string domains;
        for (const int each : rights.domains) domains += " " + std::to_string(each);
        throw Error{made + "domain" + domains + " and not for domain " + std::to_string(domain)};
    }
}

bool SecurityIdentity::maySpeakFor(const GuidPrefix& participant, std::string_view name) {
    const std::lock_guard lock{mutex_};
    const auto known = speakers_.find(participant);
    if (known != speakers_.end() && known->second.contains(name)) return true;
    const std::string_view certified = certifiedName(name);
    if (certified.empty() || certified.size() > 64) return false;
    if (!belongsTo(participant, std::string{certified})) return false;
    if (known == speakers_.end() && speakers_.size() >= mostParticipants) speakers_.clear();
    auto& names = speakers_[participant];
    if (names.size() >= mostNames) names.clear();
    names.emplace(name, agentId(name));
    return true;
}

bool SecurityIdentity::maySpeakFor(const GuidPrefix& participant, const Id& agent) {
    const std::lock_guard lock{mutex_};
    const auto known = speakers_.find(participant);
    return known != speakers_.end() && std::ranges::any_of(known->second, [&](const auto& each) {
               return each.second == agent;
           });
}

bool SecurityIdentity::hasSpoken(const GuidPrefix& participant) {
    const std::lock_guard lock{mutex_};
    return speakers_.contains(participant);
}

void SecurityIdentity::sign(Command& command) const {
    command.extras.push_back({signedList, folder_.commands});
    command.extras.push_back(
        {signatureExtra, signatureOf(signedOctets(command), folder_.key.get())});
}

std::shared_ptr<const CommandList> SecurityIdentity::listOf(const std::string& smime) {
    const std::lock_guard lock{mutex_};
    if (const auto known = lists_.find(smime); known != lists_.end()) return known->second;
    const auto text = verifiedText(smime, folder_.permissionsAuthority.get());
    auto list = text ? commandListFrom(*text) : std::nullopt;
    if (!list) return {};
    if (lists_.size() >= mostLists) lists_.clear();
    return lists_[smime] = std::make_shared<CommandList>(std::move(*list));
}

std::shared_ptr<const AgentRights> SecurityIdentity::rightsOf(const Command& command,
                                                              std::string& why) {
    const std::string* shown = extraOf(command, signedList);
    const std::string* signature = extraOf(command, signatureExtra);
    if (shown == nullptr || signature == nullptr) {
        why = "it does not say what it may command";
        return {};
    }
    const auto list = listOf(*shown);
    if (!list) {
        why = "its list of commands was changed, or is not signed by our authority";
        return {};
    }
    const AgentRights& rights = list->rights;
    if (rights.agent != certifiedName(command.sender)) {
        why = "its list of commands is that of " + rights.agent;
        return {};
    }
    const Key key = keyFromPublicText(list->key);
    if (!key || !isSignature(*signature, signedOctets(command), key.get())) {
        why = "it is not signed with the key of " + rights.agent;
        return {};
    }
    if (utcFrom(rights.until).value_or(0) < std::time(nullptr)) {
        why = "its list of commands has expired, on " + rights.until;
        return {};
    }
    return {list, &rights};
}

std::shared_ptr<const AgentRights> SecurityIdentity::shownBy(std::string_view agent,
                                                             const std::string& smime) {
    const auto list = smime.empty() ? nullptr : listOf(smime);
    if (!list) return {};
    const AgentRights& rights = list->rights;
    const bool counts = rights.agent == certifiedName(agent) &&
                        utcFrom(rights.until).value_or(0) >= std::time(nullptr) &&
                        (rights.domains.empty() || std::ranges::count(rights.domains, domain_) > 0);
    return counts ? std::shared_ptr<const AgentRights>{list, &rights} : nullptr;
}

}  // namespace cortex::comms
