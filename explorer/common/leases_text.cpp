// SPDX-License-Identifier: Apache-2.0
#include "common/leases_text.hpp"

#include "cortex/core/path.hpp"

#include <algorithm>

namespace cortex::common {

std::string leasesText(const std::vector<comms::LeaseClient::Lease>& leases) {
    std::string text;
    for (const auto& each : leases) {
        const bool below = std::ranges::any_of(leases, [&](const auto& other) {
            return other.agent == each.agent && other.prefix != each.prefix &&
                   isAtOrBelow(each.prefix, other.prefix);
        });
        if (below) continue;
        text += (text.empty() ? "" : ", ") + (each.prefix == "/" ? "everything" : each.prefix) +
                " of " + each.agent;
    }
    return text;
}

}  // namespace cortex::common
