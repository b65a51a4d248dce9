// SPDX-License-Identifier: Apache-2.0
#include "dds/participant_qos.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/service_threads.hpp"

#include "dds/network_address.hpp"
#include "dds/security_guard.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <random>
#include <string_view>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/flowcontrol/FlowControllerDescriptor.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

namespace cortex::comms {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace transport = eprosima::fastdds::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::BuiltinAttributes;
using eprosima::fastrtps::rtps::GuidPrefix_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

constexpr std::uint32_t peersPerHost = 100;  // ports asked on a peer without a port
constexpr std::uint32_t askedOnLoopback = 8;
constexpr std::uint32_t largestDatagram = 65536;
constexpr std::uint32_t mostBufferSize = 64u << 20;
constexpr const char* packets = "packets of samples";  // see limitPackets()
constexpr std::int32_t largestPacket = 60'000;
constexpr const char* discoveryMulticast = "239.255.0.1";

Duration_t milliseconds(std::uint32_t count) {
    return {static_cast<std::int32_t>(count / 1000), count % 1000 * 1'000'000};
}

// What the system grants a socket: /proc/sys/net/core/rmem_max and wmem_max.
std::uint32_t largestBuffer(const char* file) {
    std::uint64_t octets = 0;
    std::ifstream{file} >> octets;
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(octets, largestDatagram, mostBufferSize));
}

Locator_t locatorOf(const Address& address, std::uint16_t port) {
    Locator_t locator;
    locator.kind = LOCATOR_KIND_UDPv4;
    IPLocator::setIPv4(locator, address.ip);
    locator.port = address.port != 0 ? address.port : port;
    return locator;
}

bool isLoopback(const std::string& ip) { return ip.starts_with("127."); }

// Peers replace the multicast address that Fast DDS asks by default, so that address is named as
// well. On the loopback interface other vendors hear no multicast, and who keeps to it hears none
// of those who use others as well: there the first few participants are asked one by one.
void addPeers(dds::WireProtocolConfigQos& protocol, const NetworkOptions& options,
              const std::vector<std::string>& interfaces) {
    auto& list = protocol.builtin.initialPeersList;
    for (const std::string& peer : options.peers) {
        list.push_back(locatorOf(addressOf(peer, "peer"), 0));
    }
    const auto loopback = std::ranges::find_if(interfaces, isLoopback);
    if (loopback != interfaces.end()) {
        for (std::uint32_t i = 0; i < askedOnLoopback; ++i) {
            const auto port =
                protocol.port.getUnicastPort(static_cast<std::uint32_t>(options.domain), i);
            list.push_back(locatorOf({*loopback}, static_cast<std::uint16_t>(port)));
        }
    }
    // The address has its port, because Fast DDS 2.9 would otherwise ask it at the ports of single
    // participants, where nobody listens.
    const auto port = protocol.port.getMulticastPort(static_cast<std::uint32_t>(options.domain));
    if (!list.empty()) {
        list.push_back(locatorOf({discoveryMulticast}, static_cast<std::uint16_t>(port)));
    }
}

// Fast DDS does not announce the address of the loopback interface beside others. Who keeps to that
// interface could then not answer.
void announceLoopback(dds::WireProtocolConfigQos& protocol, int domain,
                      const std::vector<std::string>& interfaces) {
    if (std::ranges::none_of(interfaces, isLoopback)) return;
    if (std::ranges::all_of(interfaces, isLoopback)) return;
    const auto number = static_cast<std::uint32_t>(protocol.participant_id);
    const auto place = static_cast<std::uint32_t>(domain);
    const auto port = static_cast<std::uint16_t>(protocol.port.getUnicastPort(place, number));
    for (const std::string& each : interfaces) {
        protocol.builtin.metatrafficUnicastLocatorList.push_back(locatorOf({each}, port));
        protocol.default_unicast_locator_list.push_back(
            locatorOf({each}, static_cast<std::uint16_t>(port + 1)));
    }
    const auto multicast = static_cast<std::uint16_t>(protocol.port.getMulticastPort(place));
    protocol.builtin.metatrafficMulticastLocatorList.push_back(
        locatorOf({discoveryMulticast}, multicast));
}

// A prefix that no other participant has: vendor and random numbers. An id of the host would be
// looked up by its name, which takes seconds where no name service answers.
GuidPrefix_t newPrefix() {
    static std::random_device chance;
    static std::mutex mutex;
    const std::lock_guard lock{mutex};
    GuidPrefix_t prefix;
    prefix.value[0] = 0x01;
    prefix.value[1] = 0x0f;
    for (std::size_t i = 2; i < GuidPrefix_t::size; ++i) {
        prefix.value[i] = static_cast<std::uint8_t>(chance());
    }
    return prefix;
}

// The n-th server of the list has the identity that the command `fast-discovery-server -i n` gives.
void addServers(BuiltinAttributes& builtin, std::string_view servers) {
    for (int id = 0; !servers.empty(); ++id) {
        const std::size_t end = std::min(servers.find(';'), servers.size());
        const Address address = addressOf(std::string{servers.substr(0, end)}, "discovery server");
        transport::RemoteServerAttributes server;
        transport::get_server_client_default_guidPrefix(id, server.guidPrefix);
        server.metatrafficUnicastLocatorList.push_back(
            locatorOf(address, transport::DEFAULT_ROS2_SERVER_PORT));
        builtin.discovery_config.m_DiscoveryServers.push_back(server);
        servers.remove_prefix(std::min(end + 1, servers.size()));
    }
    builtin.discovery_config.discoveryProtocol =
        eprosima::fastrtps::rtps::DiscoveryProtocol_t::CLIENT;
}

std::shared_ptr<transport::UDPv4TransportDescriptor> udpTransport(const NetworkOptions& options) {
    auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = interfaceAddresses(options.interfaces);
    udp->maxInitialPeersRange = peersPerHost;
    udp->receiveBufferSize = largestBuffer("/proc/sys/net/core/rmem_max");
    udp->sendBufferSize = largestBuffer("/proc/sys/net/core/wmem_max");
    return udp;
}

// Fast DDS 2.9 packs consecutive samples into messages that leave no room for what security adds,
// and then ends the process. This limits what is sent in a millisecond.
void limitPackets(dds::DomainParticipantQos& qos) {
    auto limit = std::make_shared<transport::FlowControllerDescriptor>();
    limit->name = packets;
    limit->max_bytes_per_period = largestPacket;
    limit->period_ms = 1;
    qos.flow_controllers().push_back(std::move(limit));
}

// The server shows no certificate, so participants with security do not talk to it. Fast DDS 2.9
// says nothing of it, and an assertion ends the process when such a participant leaves.
void refuseServerWithSecurity(const NetworkOptions& options) {
    if (options.security.empty() || options.discoveryServer.empty()) return;
    throw Error{"a discovery server ('" + options.discoveryServer +
                "') and security exclude each other, as the server has no certificate of the "
                "security folder: nobody would be found; name the other hosts as peers (--peer) "
                "and no server (--discovery-server, CORTEX_DISCOVERY_SERVER), or no security "
                "folder (--security, CORTEX_SECURITY)"};
}

struct Profile {
    bool reliable, lateJoiners;
    std::int32_t depth;
    std::uint32_t heartbeat;  // ms
};

// In the order of Qos.
constexpr std::array profiles{
    Profile{true, true, 1, 100},    Profile{false, false, 1, 0}, Profile{true, false, 64, 10},
    Profile{true, true, 1000, 100}, Profile{true, true, 1, 300},
};

const Profile& profileOf(Qos qos) { return profiles.at(static_cast<std::size_t>(qos)); }

template <class EndpointQos>
void apply(const Profile& profile, EndpointQos& qos) {
    qos.reliability().kind =
        profile.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind =
        profile.lateJoiners ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = profile.depth;
    qos.resource_limits().max_samples = 0;  // 0: unlimited
    qos.resource_limits().max_instances = 0;
    qos.resource_limits().max_samples_per_instance = 0;
    qos.data_sharing().off();
}

}  // namespace

dds::DomainParticipantQos participantQos(const NetworkOptions& options, const std::string& name) {
    if (options.domain < 0 || options.domain > lastDomain) {
        throw Error{"domain " + std::to_string(options.domain) + " of '" + name +
                    "' does not exist; choose one from 0 to " + std::to_string(lastDomain)};
    }
    refuseServerWithSecurity(options);
    requireFiles();
    constexpr std::size_t ofParticipant = 8;
    requireThreads(ofParticipant, "joining the network");
    const int number = freeParticipant(options.domain);
    const auto udp = udpTransport(options);
    dds::DomainParticipantQos qos;
    qos.name(name);
    if (!options.security.empty()) {
        addSecurity(options.security, qos);
        limitPackets(qos);
    }
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    if (options.sharedMemory) {
        qos.transport().user_transports.push_back(
            std::make_shared<transport::SharedMemTransportDescriptor>());
    }
    qos.wire_protocol().participant_id = number;
    qos.wire_protocol().prefix = newPrefix();
    BuiltinAttributes& builtin = qos.wire_protocol().builtin;
    builtin.use_WriterLivelinessProtocol = false;  // liveliness is our own
    builtin.mutation_tries = static_cast<std::uint32_t>(participantsOfDomain);
    // An assertion of Fast DDS 2.9 ends the process where a lease ends just as its participant
    // leaves. On a busy host with many participants, a lease that ended by mistake also causes more
    // work, and so more delays.
    const auto others = static_cast<std::uint32_t>(number);
    builtin.discovery_config.leaseDuration =
        milliseconds(static_cast<std::uint32_t>(leaseOfParticipant / 1'000'000));
    builtin.discovery_config.leaseDuration_announcementperiod = milliseconds(3'000 + 150 * others);
    announceLoopback(qos.wire_protocol(), options.domain, udp->interfaceWhiteList);
    if (options.discoveryServer.empty()) {
        addPeers(qos.wire_protocol(), options, udp->interfaceWhiteList);
    } else {
        addServers(builtin, options.discoveryServer);
    }
    return qos;
}

// Late joiners get much at once. Everything else is sent one sample at a time.
bool isSentByThread(Qos qos) { return qos == Qos::State || qos == Qos::Log; }

dds::DataWriterQos writerQos(Qos qos, int othersOnHost, bool secured) {
    const Profile& profile = profileOf(qos);
    dds::DataWriterQos writer;
    apply(profile, writer);
    if (qos == Qos::Log) {  // reserved at once, so that an agent does not grow later
        auto& limits = writer.resource_limits();
        limits.max_instances = 1;
        limits.max_samples = limits.max_samples_per_instance = limits.allocated_samples =
            profile.depth;
    }
    writer.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
    if (secured && isSentByThread(qos)) {
        writer.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
        writer.publish_mode().flow_controller_name = packets;
    }
    if (profile.reliable) {
        const auto others = static_cast<std::uint32_t>(profile.lateJoiners ? othersOnHost : 0);
        writer.reliable_writer_qos().times.heartbeatPeriod =
            milliseconds(profile.heartbeat * (3 + others) / 3);
    }
    if (profile.lateJoiners) writer.reliable_writer_qos().times.nackResponseDelay = milliseconds(1);
    return writer;
}

dds::DataReaderQos readerQos(Qos qos, int othersOnHost) {
    dds::DataReaderQos reader;
    const Profile& profile = profileOf(qos);
    apply(profile, reader);
    if (profile.lateJoiners) {  // earlier samples are requested soon
        reader.reliable_reader_qos().times.initialAcknackDelay =
            milliseconds(5 + static_cast<std::uint32_t>(othersOnHost));
        reader.reliable_reader_qos().times.heartbeatResponseDelay = milliseconds(1);
    }
    return reader;
}

void setUpFastDds() {
    static std::once_flag once;
    std::call_once(once, [] {
        // This is never destroyed: the destructor would delay the end of the process by 100 ms.
        static const auto* const factory =
            new auto{dds::DomainParticipantFactory::get_shared_instance()};
        (*factory)->load_profiles();
        eprosima::fastrtps::LibrarySettingsAttributes settings;
        settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
        eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
        const char* log = std::getenv("CORTEX_DDS_LOG");  // error, warning or info
        if (!log) {
            dds::Log::ClearConsumers();
        } else if (std::string_view{log} != "error") {
            dds::Log::SetVerbosity(std::string_view{log} == "info" ? dds::Log::Kind::Info
                                                                   : dds::Log::Kind::Warning);
        }
    });
}

}  // namespace cortex::comms
