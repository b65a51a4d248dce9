// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <cstdint>
#include <string>

namespace cortex::gui {

// One start of an agent, which is told from the next one by its epoch.
struct AgentStart {
    std::string agent;
    std::int64_t epoch = 0;
    bool operator==(const AgentStart&) const = default;
};

inline AgentStart startOf(const AgentFrame& agent) {
    return {agent.status.name, agent.status.epoch};
}

}  // namespace cortex::gui
