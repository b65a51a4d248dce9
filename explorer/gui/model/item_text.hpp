// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <QString>
#include <string>

// What is said of an item besides its value.
namespace cortex::gui {

QString remarkOf(const DataItem& item);  // "constant", "measured", "set in Standby"
// What a demand is set to while nobody that is Active writes it: "safe 0", "safe: holds".
QString safeRemark(const DataItem& item);
// Its limits, whole: "−2.0943951 to 2.0943951 rad", "at least 0 s"; empty: it has none.
QString limitsText(const DataItem& item);
QString labelsText(const DataItem& item);  // "labels: 0:Off 1:On"

}  // namespace cortex::gui
