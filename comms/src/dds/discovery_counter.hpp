// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

namespace cortex::comms {

// Counts the other participants that Fast DDS has discovered. Any thread.
class DiscoveryCounter : public eprosima::fastdds::dds::DomainParticipantListener {
public:
    std::uint32_t known() const { return known_; }

    void on_participant_discovery(
        eprosima::fastdds::dds::DomainParticipant* /*us*/,
        eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
        count(info);
    }

protected:
    void count(const eprosima::fastrtps::rtps::ParticipantDiscoveryInfo& info) {
        if (info.status == info.DISCOVERED_PARTICIPANT) {
            ++known_;
        } else if (info.status != info.CHANGED_QOS_PARTICIPANT) {
            --known_;
        }
    }

private:
    std::atomic<std::uint32_t> known_{0};
};

}  // namespace cortex::comms
