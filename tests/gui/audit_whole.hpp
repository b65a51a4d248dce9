// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QStringList>

class QWidget;

namespace cortex::test {

// What is cut of what is never cut, as it is painted; a sentence each. No tooltip excuses it.
QStringList cutIn(QWidget& window);

}  // namespace cortex::test
