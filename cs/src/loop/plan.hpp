// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/image_parts.hpp"

#include "threads/scheduler.hpp"
#include "threads/thread_pool.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace cortex::cs {

// Who copies what of an image. Where threads share the tasks, a group is some chunks of one thread,
// and who runs the last of them copies what all of them wrote, while it is in its caches. Most is
// gained where the cores have no cache in common (docs/performance.md).
struct ImageGroups {
    std::vector<std::uint32_t> ofChunk;  // noGroup: at the end; empty: no groups
    ImageParts parts;
};

// Setup, or beside the loop.
ImageGroups groupImage(const Tables& tables, const Schedule& schedule);

// Which chunks the loop runs, what they copy, and the threads that run them.
struct Plan {
    Schedule schedule;
    ImageGroups image;
    std::unique_ptr<ThreadPool> pool;
};

}  // namespace cortex::cs
