// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QByteArray>
#include <QString>

namespace cortex::gui {

// Writes the whole file or leaves what was there: a full disk, or an end of the program on the way,
// destroys nothing. Empty: written; otherwise why not. A device or a pipe is never replaced.
QString writeWholeFile(const QString& file, const QByteArray& bytes);

}  // namespace cortex::gui
