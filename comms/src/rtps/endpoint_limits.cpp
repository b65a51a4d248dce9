// SPDX-License-Identifier: Apache-2.0
#include "rtps/endpoint_limits.hpp"

#include <algorithm>

namespace cortex::comms::rtps {
namespace {

constexpr std::int64_t betweenLooks = 1'000'000'000;  // ns

Prefix prefixOf(const WriterGuid& endpoint) {
    Prefix prefix;
    std::copy_n(endpoint.begin(), prefix.size(), prefix.begin());
    return prefix;
}

std::uint32_t entityOf(const WriterGuid& endpoint) {
    std::uint32_t entity = 0;
    for (std::size_t i = Prefix{}.size(); i < endpoint.size(); ++i)
        entity = entity << 8 | endpoint[i];
    return entity;
}

}  // namespace

bool EndpointLimits::admits(const WriterGuid& endpoint, const ParticipantLimits& heard,
                            std::int64_t now) {
    const std::uint32_t entity = entityOf(endpoint);
    const auto known = announced_.find(prefixOf(endpoint));
    const std::size_t ofParticipant = known != announced_.end() ? known->second.size() : 0;
    if (ofParticipant > 0 && std::ranges::find(known->second, entity) != known->second.end())
        return true;
    if (ofParticipant >= mostOfParticipant) return false;
    if (all_ >= most) forgetSilent(heard, now);
    if (all_ >= most) return false;
    announced_[prefixOf(endpoint)].push_back(entity);
    ++all_;
    return true;
}

void EndpointLimits::remove(const WriterGuid& endpoint) {
    const auto known = announced_.find(prefixOf(endpoint));
    if (known == announced_.end()) return;
    all_ -= std::erase(known->second, entityOf(endpoint));
    if (known->second.empty()) announced_.erase(known);
}

void EndpointLimits::forgetSilent(const ParticipantLimits& heard, std::int64_t now) {
    if (now - lookedAt_ < betweenLooks) return;
    lookedAt_ = now;
    std::erase_if(announced_, [&](const auto& each) {
        if (heard.isHeard(each.first, now)) return false;
        all_ -= each.second.size();
        return true;
    });
}

}  // namespace cortex::comms::rtps
