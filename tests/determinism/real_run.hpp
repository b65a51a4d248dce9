// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/transport.hpp"

#include "determinism/observation.hpp"
#include "determinism/plan.hpp"
#include "determinism/random_task.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cortex::determinism {

const TypeModel& testTypes();

// The simplexes of a plan; references into `plan` and `disturbance` stay.
SimplexTree makeTree(const Plan& plan, Disturbance& disturbance);

Snapshot snapshotOf(const Image& image);
SeenEvent seen(const Event& event, const Structure& structure);

// Hands the plan's script over, each cycle's commands backwards, and notes the answers.
class ScriptInterface final : public CommunicationInterface {
public:
    explicit ScriptInterface(const Plan& plan) : plan_{plan} {}

    const std::vector<SeenOutsideAnswer>& answers() const { return answers_; }

    void announce(const AgentAccess& agent) override;
    void read(Inbox& inbox) override;
    void write(std::int64_t cycle, Outbox& outbox) override;
    void close() override {}

private:
    struct Prepared {
        OutsideCommand command;
        std::vector<std::uint64_t> request;
    };
    const Plan& plan_;
    std::vector<Prepared> commands_;
    std::size_t next_ = 0;
    std::map<std::string, std::vector<bool>, std::less<>> answered_;  // by sender and sequence
    std::vector<SeenOutsideAnswer> answers_;
};

// Runs the plan in a ClusterCS on so many forced threads. `seed` of the delays.
Observation runOnThreads(const Plan& plan, std::uint32_t threads, std::uint64_t seed);

}  // namespace cortex::determinism
