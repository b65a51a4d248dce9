// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace cortex::profiler {

// What is done for a task, by whatever runs them.
struct TaskFunction {
    void (*run)(void* context, std::uint32_t task);
    void* context;
};

// No scheduling at all: the limit. The numbers of the tasks are a topological order.
class PlainLoop {
public:
    PlainLoop(std::uint32_t count, TaskFunction task) : count_{count}, task_{task} {}

    void cycle() {
        for (std::uint32_t each = 0; each < count_; ++each) task_.run(task_.context, each);
    }

private:
    std::uint32_t count_;
    TaskFunction task_;
};

}  // namespace cortex::profiler
