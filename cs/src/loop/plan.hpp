// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threads/scheduler.hpp"
#include "threads/thread_pool.hpp"

#include <memory>
#include <string>

namespace cortex::cs {

// Which chunks the loop runs, and the threads that run them.
struct Plan {
    Schedule schedule;
    std::unique_ptr<ThreadPool> pool;
    std::string cpus{};  // that its threads are pinned to, for people
};

}  // namespace cortex::cs
