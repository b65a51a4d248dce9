// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/transport.hpp"

#include "cortex/core/image_pool.hpp"

namespace cortex {

Image AgentAccess::newestImage() const { return images->newest(); }

std::int64_t AgentAccess::newestCycle() const { return images->newestCycle(); }

}  // namespace cortex
