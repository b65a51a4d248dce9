// SPDX-License-Identifier: Apache-2.0
#include "comms/raw_dds.hpp"

#include "dds/gate.hpp"
#include "dds/participant_qos.hpp"

#include <algorithm>
#include <functional>

#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastrtps/utils/IPLocator.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

namespace cortex::comms {
namespace {

namespace dds = eprosima::fastdds::dds;

struct RawSample {
    Id key{};
    std::vector<std::uint8_t> octets;
};

class RawType final : public dds::TopicDataType {
    using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
    using Handle = eprosima::fastrtps::rtps::InstanceHandle_t;

public:
    RawType(const std::string& name, bool keyed) {
        setName(name.c_str());
        m_typeSize = 64;
        m_isGetKeyDefined = keyed;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, Payload* payload) override {
        const auto& octets = static_cast<RawSample*>(data)->octets;
        std::copy(octets.begin(), octets.end(), payload->data);
        payload->length = static_cast<std::uint32_t>(octets.size());
        return true;
    }
    bool deserialize(Payload*, void*) override { return false; }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] {
            return static_cast<std::uint32_t>(static_cast<RawSample*>(data)->octets.size());
        };
    }
    void* createData() override { return new RawSample; }
    void deleteData(void* data) override { delete static_cast<RawSample*>(data); }
    bool getKey(void* data, Handle* handle, bool) override {
        const Id& key = static_cast<RawSample*>(data)->key;
        for (std::size_t i = 0; i < key.size(); ++i) handle->value[i] = key[i];
        return true;
    }
};

void remove(dds::DomainParticipant* participant) {
    participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}

// A socket on that port of the loopback interface; -1 if it is taken. 0: on any port.
int bound(int port) {
    const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        return descriptor;
    }
    close(descriptor);
    return -1;
}

std::uint16_t freePort() {
    const int descriptor = bound(0);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    EXPECT_EQ(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size), 0);
    close(descriptor);
    return ntohs(address.sin_port);
}

}  // namespace

struct RawWriter::Impl {
    dds::DomainParticipant* participant = nullptr;
    dds::DataWriter* writer = nullptr;
};

RawWriter::RawWriter(const NetworkOptions& options, const Topic& topic, const std::string& typeName,
                     bool keyed)
    : impl_{std::make_unique<Impl>()} {
    setUpFastDds();
    dds::DomainParticipantQos qos = participantQos(options, "raw");
    const auto gate = addGate(qos, options.domain,
                              !options.discoveryServer.empty());  // makes up for races in Fast DDS
    impl_->participant = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<dds::DomainId_t>(options.domain), qos);
    const auto held = gate->hold();
    gate->open();
    dds::TypeSupport{new RawType{typeName, keyed}}.register_type(impl_->participant);
    dds::Topic* made =
        impl_->participant->create_topic(topic.name, typeName, dds::TOPIC_QOS_DEFAULT);
    impl_->writer = impl_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT)
                        ->create_datawriter(made, writerQos(topic.qos));
}

// Fast DDS 2.9 may look for holes in the history of a writer that is being removed, for ever.
RawWriter::~RawWriter() {
    std::size_t removed = 0;
    impl_->writer->clear_history(&removed);
    remove(impl_->participant);
}

bool RawWriter::write(const Id& key, const std::vector<std::uint8_t>& octets) {
    RawSample sample{key, octets};
    return impl_->writer->write(&sample);
}

std::uint32_t RawWriter::readers() const {
    dds::PublicationMatchedStatus status;
    impl_->writer->get_publication_matched_status(status);
    return static_cast<std::uint32_t>(status.current_count);
}

struct DiscoveryServer::Impl {
    dds::DomainParticipant* participant = nullptr;
    std::uint16_t port = 0;
};

DiscoveryServer::DiscoveryServer(const NetworkOptions& options) : impl_{std::make_unique<Impl>()} {
    namespace fastrtps = eprosima::fastrtps::rtps;
    setUpFastDds();
    impl_->port = freePort();
    dds::DomainParticipantQos qos = participantQos(options, "server");
    fastrtps::Locator_t locator;
    fastrtps::IPLocator::setIPv4(locator, "127.0.0.1");
    locator.port = impl_->port;
    auto& builtin = qos.wire_protocol().builtin;
    builtin.initialPeersList.clear();
    builtin.discovery_config.discoveryProtocol = fastrtps::DiscoveryProtocol_t::SERVER;
    builtin.metatrafficUnicastLocatorList.push_back(locator);
    fastrtps::get_server_client_default_guidPrefix(0, qos.wire_protocol().prefix);
    impl_->participant = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<dds::DomainId_t>(options.domain), qos);
}

DiscoveryServer::~DiscoveryServer() { remove(impl_->participant); }

std::string DiscoveryServer::address() const { return "127.0.0.1:" + std::to_string(impl_->port); }

TakenPorts::TakenPorts(int first, int count) {
    for (int i = 0; i < count; ++i) {
        if (const int descriptor = bound(first + 2 * i); descriptor >= 0) {
            descriptors_.push_back(descriptor);
        }
    }
}

TakenPorts::~TakenPorts() {
    for (const int descriptor : descriptors_) close(descriptor);
}

}  // namespace cortex::comms
