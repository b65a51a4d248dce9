// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/agent.hpp"

#include <cstdint>
#include <map>
#include <vector>

namespace cortex::cs {

// The values that items were given to start with: in the system file, another file, on the command
// line or by the program. populate() may write where nobody gave one.
class GivenValues {
public:
    explicit GivenValues(AgentRuntime& agent);

    // After populate() of a simplex: an error for each value that it replaced by another one, of
    // its own and of what it writes.
    void check(std::uint32_t simplex, Report& report) const;

    // Once the tasks are made: an error for each value of a demand that never acts, as the demand
    // begins at its safe value.
    void checkDemands(Report& report) const;

private:
    void compare(std::uint32_t writer, std::uint32_t simplex, const Slice& written,
                 Report& report) const;

    AgentRuntime& agent_;
    std::map<std::uint32_t, std::vector<const InitialValue*>> given_;  // by simplex
};

}  // namespace cortex::cs
