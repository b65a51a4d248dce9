// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "agent/agent_model.hpp"
#include "peers/peer_model.hpp"
#include "support/agent_rig.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cortex::comms {

// An agent of every kind of data, relationship and constant, and what it tells of itself, as others
// would receive it.
class ToldAgent {
public:
    ToldAgent();

    const Structure& structure() const { return rig.agent->structure(); }
    std::string name() const { return "rig"; }
    std::int64_t epoch() const { return structure().epoch; }
    // As a hostile agent would say it: the hash of the presence is that of what it says.
    void lie(const std::string& path, const std::function<void(SimplexMessage&)>& change);
    void lie(const std::string& type, const std::function<void(TypeMessage&)>& change);
    // All own simplexes, as they are now.
    Block block(std::uint64_t sequenceNumber) const;
    Summary summary() const;

    test::AgentRig rig;
    test::Hand* worker = nullptr;
    Presence presence;
    std::vector<Model> models;
};

// Everything that it tells, in an order of its own.
void tell(const ToldAgent& agent, PeerModel& peer);

}  // namespace cortex::comms
