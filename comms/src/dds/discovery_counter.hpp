// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/repeats.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/rtps/common/Guid.h>

namespace cortex::comms {

// Counts the other participants that are known, and those that are met: that have told of an
// endpoint of theirs. Any thread.
class DiscoveryCounter : public eprosima::fastdds::dds::DomainParticipantListener {
    using Dds = eprosima::fastdds::dds::DomainParticipant;
    using Guid = eprosima::fastrtps::rtps::GUID_t;
    using Prefix = eprosima::fastrtps::rtps::GuidPrefix_t;

public:
    // Tells it from now on who comes and goes; before the participant is made.
    void tell(std::shared_ptr<Repeats> repeats) { repeats_ = std::move(repeats); }

    std::uint32_t known() const { return known_; }
    std::uint32_t met() const {
        const std::lock_guard lock{mutex_};
        return static_cast<std::uint32_t>(met_.size());
    }

    void on_participant_discovery(
        Dds*, eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
        count(info);
    }
    void on_publisher_discovery(Dds* us,
                                eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
        if (info.status == info.DISCOVERED_WRITER) meet(*us, info.info.guid());
    }
    void on_subscriber_discovery(Dds* us,
                                 eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override {
        if (info.status == info.DISCOVERED_READER) {
            const bool reliable = info.info.m_qos.m_reliability.kind ==
                                  eprosima::fastdds::dds::RELIABLE_RELIABILITY_QOS;
            if (reliable)
                repeats_->readerFound(info.info.guid(), info.info.topicName().to_string());
            meet(*us, info.info.guid());
        } else if (info.status == info.REMOVED_READER) {
            repeats_->readerGone(info.info.guid());
        }
    }

protected:
    void count(const eprosima::fastrtps::rtps::ParticipantDiscoveryInfo& info) {
        const Prefix& who = info.info.m_guid.guidPrefix;
        if (info.status == info.DISCOVERED_PARTICIPANT) {
            ++known_;
            std::vector<Repeats::Locator> at;
            for (const auto& each : info.info.metatraffic_locators.unicast) at.push_back(each);
            for (const auto& each : info.info.default_locators.unicast) at.push_back(each);
            repeats_->newcomer(who, at);
        } else if (info.status != info.CHANGED_QOS_PARTICIPANT) {
            --known_;
            repeats_->gone(who);
            const std::lock_guard lock{mutex_};
            met_.erase(who);
        }
    }

private:
    void meet(const Dds& us, const Guid& endpoint) {
        if (endpoint.guidPrefix == us.guid().guidPrefix) return;
        const std::lock_guard lock{mutex_};
        met_.insert(endpoint.guidPrefix);
    }

    std::shared_ptr<Repeats> repeats_;
    std::atomic<std::uint32_t> known_{0};
    mutable std::mutex mutex_;
    std::set<Prefix> met_;
};

}  // namespace cortex::comms
