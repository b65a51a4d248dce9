// SPDX-License-Identifier: Apache-2.0
#include "live/safe_demand.hpp"

namespace cortex::cli {

std::string qualityText(Quality quality, const StaleDemand& demand) {
    return std::string{name(quality)} + (demand.safe ? ", safe" : "");
}

Json safeJson(const StaleDemand& demand) { return demand.safe ? Json(demand.why) : Json(); }

}  // namespace cortex::cli
