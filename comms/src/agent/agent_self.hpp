// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/communication_interface.hpp"

#include "wire/messages.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace cortex::comms {

// ns of this host's monotonic clock.
std::int64_t steadyNow() CORTEX_REALTIME;

// What others sent and we did not take: how often, and why the last time. Any thread.
class Rejections {
public:
    void add(std::string_view reason);
    std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
    std::string last() const;

private:
    std::atomic<std::uint64_t> count_{0};
    mutable std::mutex mutex_;
    std::string last_;
};

// Who this agent is on the network. Made by announce(); used by the communication thread.
struct AgentSelf {
    explicit AgentSelf(const AgentAccess& agent);

    const Structure& structure() const { return *access.structure; }
    // An event outside the cycles.
    void event(Severity severity, std::uint32_t simplex, std::string_view text) const;

    AgentAccess access;
    std::string name, host;
    Id id;
    std::int64_t epoch;
    std::uint32_t simplex;  // /<name>
    Rejections rejections;
};

}  // namespace cortex::comms
