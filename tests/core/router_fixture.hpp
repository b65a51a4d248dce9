// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/agent_rig.hpp"

#include <gtest/gtest.h>

namespace cortex::test {

// Commands from outside to /worker and /plate.
struct Router : testing::Test {
    AgentRig rig{"rig", {.outsideCommands = 8}};
    Hand& worker = rig.hand("/worker");
    Simplex& plate = rig.tree.add("/plate", "Plate");
    int calls = 0;

    void start() {
        rig.make();
        worker.on("poke", [this](Call&) { return ++calls, Outcome::Done; });
        rig.start();
    }
    void SetUp() override { worker.state = State::Active; }
    PlayedInterface::Answer answerTo(const PlayedInterface::Message& message) {
        rig.outside.send(message);
        rig.step();
        return rig.outside.last();
    }
};

}  // namespace cortex::test
