// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"
#include "cortex/core/communication_interface.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace cortex::comms {

// Puts an agent on the network: others see it, link its simplexes and send it commands; it links
// theirs. cluster.addInterface<DdsInterface>(options); start() throws Error if the network cannot
// be joined. DDS is used by a thread of its own, never by the loop.
class DdsInterface final : public CommunicationInterface {
public:
    explicit DdsInterface(NetworkOptions options = {});
    ~DdsInterface() override;

    void announce(const AgentAccess& agent) override;
    void read(Inbox& inbox) CORTEX_REALTIME override;
    void write(std::int64_t cycle, Outbox& outbox) CORTEX_REALTIME override;
    void close() override;

    // What others sent that was malformed or cannot be, and why the last time; until close().
    std::uint64_t rejected() const;
    std::string lastRejection() const;
    // Samples of linked simplexes that were sent and did not come; until close().
    std::uint64_t lost() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::comms
