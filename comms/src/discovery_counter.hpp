// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "participant.hpp"
#include "repeats.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

namespace cortex::comms {

// Counts the other participants that are known, and those of agents and tools that have told what
// they write. Any thread.
class DiscoveryCounter : public eprosima::fastdds::dds::DomainParticipantListener {
public:
    // Tells it from now on who comes and goes; before the participant is made.
    void tell(std::shared_ptr<Repeats> repeats) { repeats_ = std::move(repeats); }

    std::uint32_t known() const { return known_; }
    std::uint32_t met() const { return met_; }  // others, since the start; also who has left

    void on_participant_discovery(
        eprosima::fastdds::dds::DomainParticipant*,
        eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
        count(info);
    }
    void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* us,
                                eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
        const auto& writer = info.info;
        const bool isNew = info.status == info.DISCOVERED_WRITER &&
                           writer.guid().guidPrefix != us->guid().guidPrefix;
        if (isNew && writer.topicName() == topics::presence.name.c_str()) ++met_;
    }

protected:
    void count(const eprosima::fastrtps::rtps::ParticipantDiscoveryInfo& info) {
        if (info.status == info.DISCOVERED_PARTICIPANT) {
            ++known_;
            if (!repeats_) return;
            for (const auto& at : info.info.metatraffic_locators.unicast) {
                repeats_->newcomer(info.info.m_guid.guidPrefix, at);
            }
        } else if (info.status != info.CHANGED_QOS_PARTICIPANT) {
            --known_;
            if (repeats_) repeats_->gone(info.info.m_guid.guidPrefix);
        }
    }

private:
    std::shared_ptr<Repeats> repeats_;  // null: with a discovery server
    std::atomic<std::uint32_t> known_{0}, met_{0};
};

}  // namespace cortex::comms
