// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"
#include "cortex/core/command.hpp"
#include "cortex/core/path.hpp"
#include "cortex/core/transport.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cortex {

struct Lease {
    EventText prefix;                     // without a slash at its end; "/" for all
    Sender holder;                        // epoch 0: handed over, and not renewed yet
    std::array<char, 32> onBehalfOf{};    // who is behind it, as it said last; often empty
    std::int64_t since = 0, renewed = 0;  // cycles
    bool held = false;

    bool heldBy(const Sender& sender) const CORTEX_REALTIME;
    void actFor(std::string_view person) CORTEX_REALTIME;
    EventText holderText() const CORTEX_REALTIME;  // "cortex@desk.4711-5e1f0a for alice"
    EventText refusal() const CORTEX_REALTIME;     // "/arm is held by ..."
};

// Who controls which part of the plant: taken, renewed, handed over and released by commands to
// /<agent>, shown as its data, lost 2 s after the last renewal. Loop thread, between cycles.
class LeaseTable {
public:
    static constexpr std::uint32_t capacity = 8;

    explicit LeaseTable(AgentRuntime& runtime);

    // A lease of somebody else that forbids commands to what lies below `path`; null if none. With
    // `wide` also one further down counts: the command goes to everything below.
    const Lease* other(std::string_view path, bool wide, const Sender& sender) const
        CORTEX_REALTIME;
    bool covered(std::string_view path, const Sender& sender) const CORTEX_REALTIME;

    Outcome take(Call& call, std::string_view prefix, std::int64_t cycle) CORTEX_REALTIME;
    Outcome renew(Call& call, std::string_view prefix, std::int64_t cycle) CORTEX_REALTIME;
    Outcome handOver(Call& call, std::string_view prefix, std::string_view to, std::int64_t cycle)
        CORTEX_REALTIME;
    Outcome release(Call& call, std::string_view prefix) CORTEX_REALTIME;

    // The next lease that is over, taken out of the table; false: none.
    bool takeExpired(std::int64_t cycle, Lease& lost) CORTEX_REALTIME;
    bool takeLeaseOf(const Sender& sender, Lease& lost) CORTEX_REALTIME;

private:
    Lease* mine(Call& call, std::string_view prefix) CORTEX_REALTIME;
    void show(const Lease& lease) CORTEX_REALTIME;

    std::array<Lease, capacity> leases_;
    std::int64_t lifetime_;  // cycles
    const Structure& structure_;
    std::byte* prefixes_ = nullptr;  // the items of the agent's simplex, where its type has them
    std::byte* holders_ = nullptr;
    std::int64_t* since_ = nullptr;
    std::uint32_t prefixStride_ = 0, holderStride_ = 0;
};

}  // namespace cortex
