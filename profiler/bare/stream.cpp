// SPDX-License-Identifier: Apache-2.0
#include "stream.hpp"

#include <stdexcept>
#include <utility>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

namespace cortex::profiler {
namespace {

namespace dds = eprosima::fastdds::dds;
using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;

constexpr std::uint32_t socketBuffer = 1U << 20U;

dds::DomainParticipantQos participantQos() {
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->receiveBufferSize = socketBuffer;
    udp->sendBufferSize = socketBuffer;
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    return qos;
}

template <class Qos>
Qos endpointQos() {
    Qos qos;
    qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 1;
    qos.data_sharing().off();
    return qos;
}

class Listener final : public dds::DataReaderListener {
public:
    explicit Listener(Stream::OnData onData) : onData_{std::move(onData)} {}

private:
    void on_data_available(dds::DataReader* reader) override {
        dds::SampleInfo info;
        while (reader->take_next_sample(&data_, &info) == ReturnCode::RETCODE_OK) {
            if (info.valid_data && onData_) onData_(data_);
        }
    }

    const Stream::OnData onData_;
    Octets::Data data_;
};

}  // namespace

struct Stream::Implementation {
    explicit Implementation(OnData onData) : listener{std::move(onData)} {}

    Listener listener;
    dds::DomainParticipant* participant = nullptr;
    dds::DataWriter* writer = nullptr;
};

Stream::Stream(int domain, Role role, OnData onData)
    : implementation_{std::make_unique<Implementation>(std::move(onData))} {
    Implementation& self = *implementation_;
    self.participant = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<dds::DomainId_t>(domain), participantQos());
    if (!self.participant) throw std::runtime_error{"Fast DDS refused a participant"};
    dds::TypeSupport{new Octets}.register_type(self.participant);
    dds::Topic* topic = self.participant->create_topic("bare", "Octets", dds::TOPIC_QOS_DEFAULT);
    if (role == Role::Writer) {
        auto qos = endpointQos<dds::DataWriterQos>();
        qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
        self.writer = self.participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT)
                          ->create_datawriter(topic, qos);
    } else {
        self.participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)
            ->create_datareader(topic, endpointQos<dds::DataReaderQos>(), &self.listener);
    }
}

Stream::~Stream() {
    implementation_->participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(implementation_->participant);
}

bool Stream::write(Octets::Data& data) { return implementation_->writer->write(&data); }

}  // namespace cortex::profiler
