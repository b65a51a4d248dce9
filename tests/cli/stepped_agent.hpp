// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

namespace cortex::test {

// The agent "robot" in this process, on loopback, that the test steps. /signal.count is the number
// of the cycle.
class SteppedRobot {
public:
    explicit SteppedRobot(int domain);
    ~SteppedRobot();

    void step(std::int64_t cycles);
    std::int64_t cycle() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::test
