// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include "wire/messages.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// Counts what others sent and this agent refused, by reason, and keeps the last reason. Any thread.
class Rejections {
public:
    void add(std::string_view reason);
    std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
    std::string last() const;
    // What was refused since the last report: a sentence for each reason, at most one a second.
    std::vector<std::string> takeReports(std::int64_t now);
    std::map<std::string, std::uint64_t> byReason() const;

private:
    struct Reason {
        std::uint64_t count = 0, reported = 0;
        std::int64_t told = 0;
    };
    std::atomic<std::uint64_t> count_{0};
    mutable std::mutex mutex_;
    std::string last_;
    std::map<std::string, Reason, std::less<>> reasons_;  // bounded: others invent names
};

// Whether a start (UTC microseconds) can have been: after 1970, and at most a day ahead of our
// clock.
bool isStart(std::int64_t epoch);

// The identity of this agent on the network. announce() makes it, and the communication thread uses
// it.
struct AgentSelf {
    explicit AgentSelf(const AgentAccess& agent);

    const Structure& structure() const { return *access.structure; }
    // Posts an event from outside the loop.
    void event(Severity severity, std::uint32_t simplex, std::string_view text,
               EventKind kind = EventKind::Agent) const;

    AgentAccess access;
    std::string name, host;
    Id id;
    std::int64_t epoch;
    std::uint32_t simplex;  // /<name>
    std::int64_t began;     // monotonicNow()
    Rejections rejections;
};

}  // namespace cortex::comms
