// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/transport.hpp"

#include "agent/link_table.hpp"
#include "commands/lane.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cortex {

// The far ends of the lanes that lead to simplexes of other agents. What tasks sent is offered to
// the interface that links the target; a lane gets its answers in the order in which it sent.
// Everything is sized at start(). Loop thread, in beginCycle() and endCycle().
class AgentCalls {
public:
    AgentCalls(AgentRuntime& runtime, const LinkTable& links, std::span<Lane* const> lanes);

    void answer(const AgentCallAnswer& answer) CORTEX_REALTIME;
    void release() CORTEX_REALTIME;  // into the lanes, after all interfaces were read
    void expire() CORTEX_REALTIME;   // what was sent to a simplex that no interface links
    // The next command that was not offered yet, to a simplex that this interface links.
    bool next(std::uint32_t interface, AgentCall& call) CORTEX_REALTIME;

private:
    struct Call {
        std::uint64_t ticket = 0;  // 0: free
        std::uint32_t number = 0, command = 0;
        std::uint16_t handle = 0;
        bool released = false;  // its slot was answered: with Running
        bool settled = false;   // the verdict is there, and not released
        Verdict verdict;
        ChunkClock sent;
        std::uint32_t size = 0;
        std::byte* response = nullptr;
    };
    struct Port {
        Lane* lane = nullptr;
        std::span<Call> calls;
        std::vector<Call*> order;  // a ring: those whose slots are not answered
        std::uint32_t first = 0, count = 0;
        std::uint32_t running = 0;  // released, and not ended
    };
    Call* offer(Port& port) CORTEX_REALTIME;  // null: nothing waits, or too much is on its way
    void releaseSlot(Port& port, Call& call) CORTEX_REALTIME;
    void releaseFinal(Port& port, Call& call) CORTEX_REALTIME;
    void report(Port& port, const Call& call) CORTEX_REALTIME;

    AgentRuntime& runtime_;
    const LinkTable& links_;
    std::vector<Call> calls_;
    std::vector<Port> ports_;
    std::vector<std::byte> responses_;
    std::uint64_t serial_ = 0;
};

}  // namespace cortex
