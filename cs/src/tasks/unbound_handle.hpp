// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/error.hpp"
#include "cortex/core/tables.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include "tasks/hook.hpp"

namespace cortex::cs {

// A member is found by what stands beside it in the object: " between those of 'level' and 'flow'",
// the items of the nearest bound handles. Empty where the handle is no member.
EventText neighboursOf(const UnboundHandle& unbound, const SimplexCS& simplex,
                       const Tables& tables);

// All that is known, for the event of the fault.
EventText textOf(const UnboundHandle& unbound, const SimplexCS& simplex, const Tables& tables,
                 Hook hook);
// The same for the item faultText, into which it fits.
EventText briefOf(const UnboundHandle& unbound, Hook hook);

}  // namespace cortex::cs
