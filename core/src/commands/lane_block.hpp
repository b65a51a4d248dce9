// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/lane.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace cortex {

// All lanes of an agent, one behind the other with their slots, in the order given.
class LaneBlock {
public:
    struct Plan {
        Lane::Shape shape;
        std::vector<CommandSender::State*> handles;  // that get the lane
    };
    explicit LaneBlock(std::vector<Plan> plans);
    ~LaneBlock();
    LaneBlock(const LaneBlock&) = delete;
    LaneBlock& operator=(const LaneBlock&) = delete;

    std::span<Lane* const> lanes() const { return lanes_; }

private:
    struct Line {
        alignas(64) std::byte octets[64];
    };
    std::vector<Line> memory_;
    std::vector<Lane*> lanes_;
};

}  // namespace cortex
