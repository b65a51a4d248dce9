// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace cortex::profiler {

// The network as the loop sees it, with a stopwatch at its door. The program starts and takes the
// measurement, all else is called by the agent.
class TimedInterface final : public CommunicationInterface {
public:
    // Without an interface nothing is called: what the stopwatch itself takes.
    explicit TimedInterface(std::unique_ptr<CommunicationInterface> interface);

    void record();
    std::vector<std::int64_t> take();  // ns of each cycle's read() and write(); ends it

    void announce(const AgentAccess& agent) override;
    void read(Inbox& inbox) override;
    void write(std::int64_t cycle, Outbox& outbox) override;
    void close() override;

private:
    std::unique_ptr<CommunicationInterface> interface_;
    std::int64_t reading_ = 0;
    std::mutex mutex_;
    bool records_ = false;
    std::vector<std::int64_t> costs_;
};

}  // namespace cortex::profiler
