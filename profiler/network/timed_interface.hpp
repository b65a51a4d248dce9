// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image.hpp"
#include "cortex/core/image_pool.hpp"
#include "cortex/core/transport.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace cortex::network {

// What each cycle paid, ns.
struct Costs {
    std::vector<std::int64_t> readAndWrite;
    std::vector<std::int64_t> image;  // a copy of all tables, made beside the agent's own
};

// Wakes a thread in each cycle, and that is all: what write() would take at least, where somebody
// wants every cycle, if the communication thread did not come by itself.
class Waker final : public CommunicationInterface {
public:
    void announce(const AgentAccess& agent) override;
    void read(Inbox& /*inbox*/) override {}
    void write(std::int64_t cycle, Outbox& outbox) override;
    void close() override;

private:
    std::atomic<std::int64_t> cycle_{0};
    std::thread thread_;
};

// The network as the loop sees it, with a stopwatch at its door. The program starts and takes the
// measurement, all else is called by the agent.
class TimedInterface final : public CommunicationInterface {
public:
    // In the loop, for each sample of a linked simplex that it is given.
    using OnLink = std::function<void(std::uint32_t simplex, const Slice& values)>;

    // Without an interface nothing is called: what the stopwatch itself takes.
    explicit TimedInterface(std::unique_ptr<CommunicationInterface> interface, OnLink onLink = {});

    void record(ImagePool& pool);
    Costs take();                                          // and ends it
    std::int64_t announced() const { return announced_; }  // steadyNow() before it joined

    void announce(const AgentAccess& agent) override;
    void read(Inbox& inbox) override;
    void write(std::int64_t cycle, Outbox& outbox) override;
    void close() override;

private:
    std::unique_ptr<CommunicationInterface> interface_;
    OnLink onLink_;
    std::int64_t announced_ = 0;
    std::int64_t reading_ = 0;
    std::mutex mutex_;
    ImagePool* pool_ = nullptr;  // while it records
    Costs costs_;
};

}  // namespace cortex::network
