// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/safe_demand.hpp"
#include "text/output.hpp"

#include <string>

// Safe demands in the texts and in the JSON of `cortex`.
namespace cortex::cli {

using common::safeBecause;
using common::StaleDemand;

// "stale, safe", or the name of the quality.
std::string qualityText(Quality quality, const StaleDemand& demand);
Json safeJson(const StaleDemand& demand);  // why it is safe; null where it is not

}  // namespace cortex::cli
