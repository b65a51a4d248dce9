// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/transport.hpp"

#include <cstdint>
#include <vector>

namespace cortex {

// The simplexes of other agents that ours name: copies fresh samples into their slices and judges
// what has become old. Loop thread, in beginCycle().
class LinkTable {
public:
    explicit LinkTable(AgentRuntime& runtime);

    void link(std::uint32_t simplex, const LinkBinding& binding, const Slice& from,
              std::int64_t age) CORTEX_REALTIME;
    void constants(std::uint32_t simplex, const LinkBinding& binding, const Slice& from)
        CORTEX_REALTIME;
    void lost(std::uint32_t simplex) CORTEX_REALTIME;
    void age() CORTEX_REALTIME;  // after all interfaces were read

private:
    struct Link {
        std::uint32_t simplex;
        Slice slice;
        std::int64_t freshTime = 0, period = 0;  // ns, nominal time
        bool bound = false, reported = false;
    };
    Link* find(std::uint32_t simplex) CORTEX_REALTIME;
    void post(Severity severity, std::uint32_t simplex, const char* text) CORTEX_REALTIME;

    AgentRuntime& runtime_;
    std::uint32_t first_ = 0;  // index of the first remote simplex: they stand last
    std::vector<Link> links_;
};

}  // namespace cortex
