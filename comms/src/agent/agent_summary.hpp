// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_peers.hpp"
#include "agent/agent_self.hpp"
#include "dds/participant.hpp"
#include "wire/simplex_marks.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace cortex::comms {

// Says five times a second how all simplexes of this agent are, while somebody asks for it. All of
// it is done here, nothing by the loop. Communication thread only. Times are ns of monotonicNow().
class AgentSummary {
public:
    AgentSummary(AgentSelf& self, const Id& structureHash, Participant& participant);

    void update(const Peers& peers);  // after the peers have changed
    void step(std::int64_t now);
    void renew() { writer_.reset(); }  // before its participant is replaced, then update()

private:
    bool make();

    AgentSelf& self_;
    Participant& participant_;
    std::optional<SimplexMarks> marks_;        // once somebody has asked
    std::unique_ptr<Writer<Summary>> writer_;  // the same
    Summary summary_;
    bool wanted_ = false;
    std::int64_t due_ = 0;
};

}  // namespace cortex::comms
