// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threads/scheduler.hpp"
#include "threads/thread_pool.hpp"

#include <memory>

namespace cortex::cs {

// Which chunks the loop runs, and the threads that run them.
struct Plan {
    Schedule schedule;
    std::unique_ptr<ThreadPool> pool;
};

}  // namespace cortex::cs
