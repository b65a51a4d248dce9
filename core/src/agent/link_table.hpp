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

    static constexpr std::uint32_t none = 0xffffffffU;

    void offered(std::uint32_t simplex) CORTEX_REALTIME;
    void link(std::uint32_t simplex, const LinkBinding& binding, const Slice& from,
              std::int64_t age, std::uint32_t interface) CORTEX_REALTIME;
    void constants(std::uint32_t simplex, const LinkBinding& binding, const Slice& from)
        CORTEX_REALTIME;
    void lost(std::uint32_t simplex) CORTEX_REALTIME;
    void age() CORTEX_REALTIME;  // after all interfaces were read
    // Through which it is linked; `none`: its agent is not heard.
    std::uint32_t interfaceOf(std::uint32_t simplex) const CORTEX_REALTIME {
        const Link& link = links_[simplex - first_];
        return link.bound ? link.interface : none;
    }

private:
    struct Link {
        std::uint32_t simplex;
        Slice slice;
        std::int64_t freshTime = 0, period = 0;  // ns, nominal time
        std::uint32_t interface = none;
        std::int64_t silent = 0;  // cycles of ours since its last sample
        bool bound = false, reported = false;
    };
    Link* find(std::uint32_t simplex) CORTEX_REALTIME;
    void setBound(Link& link, bool bound) CORTEX_REALTIME;
    void tellMissing(bool offered, const char* what) CORTEX_REALTIME;
    void post(Severity severity, std::uint32_t simplex, const char* text) CORTEX_REALTIME;

    AgentRuntime& runtime_;
    std::uint32_t first_ = 0;  // index of the first remote simplex: they stand last
    std::vector<Link> links_;
    bool toldMissing_ = false;
};

}  // namespace cortex
