// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include <functional>
#include <utility>

namespace cortex::toolkit {

// Something to do in ClusterCS::start(), when all simplexes are populated, the interfaces that were
// added before have joined, and nothing runs yet. What it throws ends the start.
class StartStep final : public CommunicationInterface {
public:
    explicit StartStep(std::function<void()> step) : step_{std::move(step)} {}
    void announce(const AgentAccess& /*agent*/) override { step_(); }
    void read(Inbox& /*inbox*/) override {}
    void write(std::int64_t /*cycle*/, Outbox& /*outbox*/) override {}
    void close() override {}

private:
    std::function<void()> step_;
};

}  // namespace cortex::toolkit
