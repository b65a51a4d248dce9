// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"
#include "cortex/core/transport.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace cortex::comms {

// Connects an agent to the network: others see it, link its simplexes and send it commands, and it
// links theirs. Use it with cluster.addInterface<DdsInterface>(options); start() throws Error if
// the network cannot be joined. A thread of its own uses DDS, never the loop.
class DdsInterface final : public CommunicationInterface {
public:
    explicit DdsInterface(NetworkOptions options = {});
    ~DdsInterface() override;

    void announce(const AgentAccess& agent) override;
    void read(Inbox& inbox) CORTEX_REALTIME override;
    void write(std::int64_t cycle, Outbox& outbox) CORTEX_REALTIME override;
    void close() override;

    // How many samples of others were malformed or impossible, and the last reason; until close().
    std::uint64_t rejected() const;
    std::string lastRejection() const;
    std::map<std::string, std::uint64_t> rejections() const;  // the same number, by reason
    // Whether another start of this agent's name was there first, so that this one is silent.
    bool isSecond() const;
    // How many samples of linked simplexes were sent and did not arrive; until close().
    std::uint64_t lost() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::comms
