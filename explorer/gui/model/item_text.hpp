// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <QString>

// What is said of an item besides its value.
namespace cortex::explorer {

QString remarkOf(const DataItem& item);  // "constant", "measured", "set in Standby"
// What a demand is set to while nobody that is Active writes it: "safe 0", "safe: holds".
QString safeRemark(const DataItem& item);
QString labelsText(const DataItem& item);  // "labels: 0:Off 1:On"

}  // namespace cortex::explorer
