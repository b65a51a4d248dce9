// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include "wire/messages.hpp"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace cortex::comms {

// Counts what others sent and this agent refused, and keeps the last reason. Any thread.
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

// The identity of this agent on the network. announce() makes it, and the communication thread uses
// it.
struct AgentSelf {
    explicit AgentSelf(const AgentAccess& agent);

    const Structure& structure() const { return *access.structure; }
    // Posts an event from outside the loop.
    void event(Severity severity, std::uint32_t simplex, std::string_view text) const;

    AgentAccess access;
    std::string name, host;
    Id id;
    std::int64_t epoch;
    std::uint32_t simplex;  // /<name>
    Rejections rejections;
};

}  // namespace cortex::comms
