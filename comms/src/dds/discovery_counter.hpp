// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

namespace cortex::comms {

// Counts the other participants that Fast DDS has discovered, and tells their writers. Any thread.
class DiscoveryCounter : public eprosima::fastdds::dds::DomainParticipantListener {
public:
    using Guid = eprosima::fastrtps::rtps::GUID_t;

    // Of each writer of others; to be set before the participant is made.
    std::function<void(const Guid&, std::string_view topic)> onWriter;

    // With the number of participants that are known; to be set before as well.
    std::function<void(std::uint32_t)> onKnown;

    std::uint32_t known() const { return known_; }
    std::uint32_t secured() const { return secured_; }  // those of them that ask for security

    void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* /*us*/,
                                eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
        if (info.status == info.DISCOVERED_WRITER && onWriter) {
            onWriter(info.info.guid(), info.info.topicName().c_str());
        }
    }

    void on_participant_discovery(
        eprosima::fastdds::dds::DomainParticipant* /*us*/,
        eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
        count(info);
    }

protected:
    void count(const eprosima::fastrtps::rtps::ParticipantDiscoveryInfo& info) {
        const std::uint32_t secured = info.info.identity_token_.class_id().empty() ? 0 : 1;
        if (info.status == info.DISCOVERED_PARTICIPANT) {
            ++known_;
            secured_ += secured;
        } else if (info.status != info.CHANGED_QOS_PARTICIPANT) {
            --known_;
            secured_ -= secured;
        }
        if (onKnown) onKnown(known_);
    }

private:
    std::atomic<std::uint32_t> known_{0}, secured_{0};
};

}  // namespace cortex::comms
