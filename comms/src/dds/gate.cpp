// SPDX-License-Identifier: Apache-2.0
#include "dds/gate.hpp"

#include "cortex/core/clock.hpp"

#include "rtps/pieces.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fastdds/rtps/common/LocatorList.hpp>
#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastrtps/config.h>

namespace cortex::comms {
namespace {

namespace transport = eprosima::fastdds::rtps;
namespace fastrtps = eprosima::fastrtps::rtps;

static_assert(
    FASTRTPS_VERSION_MAJOR == 2 && FASTRTPS_VERSION_MINOR == 9,
    "The gate makes up for faults of Fast DDS 2.9. Before you build with another version, "
    "find out which of them it still has, and whether its lock order allows the gate.");

constexpr std::chrono::milliseconds longestWait{250};

std::uint32_t ipOf(const fastrtps::Locator_t& locator) {
    const fastrtps::octet* const ip = locator.address + 12;
    return static_cast<std::uint32_t>(ip[0]) << 24 | static_cast<std::uint32_t>(ip[1]) << 16 |
           static_cast<std::uint32_t>(ip[2]) << 8 | ip[3];
}

class GatedTransport final : public transport::ChainingTransport {
public:
    GatedTransport(const transport::ChainingTransportDescriptor& descriptor,
                   std::shared_ptr<Gate> gate)
        : ChainingTransport{descriptor},
          lower_{descriptor.low_level_descriptor},
          gate_{std::move(gate)} {}

    transport::TransportDescriptorInterface* get_configuration() override { return lower_.get(); }

    // **Invariant:** each datagram that goes to the transport of Fast DDS ends with its statistics
    // submessage. That transport looks at one byte, 60 before the end. If it is 0x80, it writes
    // destination, time and counters over the 56 bytes behind it, whatever they are. Fast DDS ends
    // each datagram so, a signed one behind its end, and piecesOf() each piece. A piece of one that
    // has none gets an empty one if that byte is 0x80. Nothing is put behind what is sent whole.
    // Without FASTDDS_STATISTICS there are no such submessages, and nothing is written over.
    bool send(fastrtps::SenderResource* lower, const fastrtps::octet* octets, std::uint32_t size,
              fastrtps::LocatorsIterator* begin, fastrtps::LocatorsIterator* end,
              const std::chrono::steady_clock::time_point& timeout) override {
        const rtps::Bytes datagram{const_cast<fastrtps::octet*>(octets), size};  // only read
        gate_->filter.noteSent(datagram, monotonicNow());
        std::vector<rtps::Message> pieces = rtps::piecesOf(datagram, gate_->cutWriter);
#ifdef FASTDDS_STATISTICS
        for (rtps::Message& each : pieces) rtps::endWithStatistics(each);
#endif
        if (gate_->repeatsEndpoints && rtps::isAboutEndpoints(datagram)) {
            if (pieces.empty()) pieces.emplace_back(octets, octets + size);
            const std::size_t once = pieces.size();
            while (pieces.size() < 3 * once) pieces.push_back(pieces[pieces.size() - once]);
        }
        if (pieces.empty()) return lower->send(octets, size, begin, end, timeout);
        transport::LocatorList to;
        for (; *begin != *end; ++*begin) to.push_back(**begin);
        bool sent = true;
        for (const rtps::Message& each : pieces) {
            transport::Locators first{to.begin()}, last{to.end()};
            sent = lower->send(each.data(), static_cast<std::uint32_t>(each.size()), &first, &last,
                               timeout) &&
                   sent;
        }
        return sent;
    }

    void receive(transport::TransportReceiverInterface* upper, const fastrtps::octet* octets,
                 std::uint32_t size, const fastrtps::Locator_t& local,
                 const fastrtps::Locator_t& remote) override {
        // The buffer of Fast DDS, into which it writes each datagram. It only passes it on as
        // const.
        const rtps::Bytes datagram{const_cast<fastrtps::octet*>(octets), size};
        const auto [whole, left] = gate_->filter.admit(datagram, ipOf(remote), monotonicNow());
        if (whole.empty() && left <= rtps::headerSize) return;
        const std::unique_lock passing = gate_->pass();
        if (!passing) return;
        for (const rtps::Message& each : whole) {
            upper->OnDataReceived(each.data(), static_cast<std::uint32_t>(each.size()), local,
                                  remote);
        }
        if (left > rtps::headerSize) {
            upper->OnDataReceived(octets, static_cast<std::uint32_t>(left), local, remote);
        }
    }

private:
    const std::shared_ptr<transport::TransportDescriptorInterface> lower_;
    const std::shared_ptr<Gate> gate_;
};

struct GatedTransportDescriptor final : transport::ChainingTransportDescriptor {
    GatedTransportDescriptor(std::shared_ptr<TransportDescriptorInterface> lower,
                             std::shared_ptr<Gate> theGate)
        : ChainingTransportDescriptor{std::move(lower)}, gate{std::move(theGate)} {}

    transport::TransportInterface* create_transport() const override {
        return new GatedTransport{*this, gate};
    }

    const std::shared_ptr<Gate> gate;
};

}  // namespace

void Gate::open() {
    {
        const std::lock_guard lock{mutex_};
        isOpen_ = true;
    }
    opened_.notify_all();
}

std::unique_lock<std::mutex> Gate::pass() {
    if (!isOpen_) {
        std::unique_lock lock{mutex_};
        opened_.wait_for(lock, longestWait, [&] { return isOpen_.load(); });
        isOpen_ = true;
    }
    std::unique_lock passing{passing_};
    if (isClosed_) passing.unlock();
    return passing;
}

std::shared_ptr<Gate> addGate(eprosima::fastdds::dds::DomainParticipantQos& qos, int domain,
                              bool isRelayed) {
    rtps::Prefix us;
    std::copy_n(qos.wire_protocol().prefix.value, us.size(), us.begin());
    auto gate = std::make_shared<Gate>(us, domain, isRelayed);
    auto& lower = qos.transport().user_transports.front();
    lower = std::make_shared<GatedTransportDescriptor>(lower, gate);
    return gate;
}

}  // namespace cortex::comms
