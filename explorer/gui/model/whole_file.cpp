// SPDX-License-Identifier: Apache-2.0
#include "model/whole_file.hpp"

#include <QCoreApplication>
#include <QFileInfo>
#include <QSaveFile>

namespace cortex::gui {

QString writeWholeFile(const QString& file, const QByteArray& bytes) {
    const QFileInfo before{file};
    if (before.exists() && !before.isFile())
        return QCoreApplication::translate("Files", "it is no ordinary file");
    QSaveFile target{file};
    // Without a buffer: a buffer that cannot be flushed would be taken for written.
    const bool written = target.open(QIODevice::WriteOnly | QIODevice::Unbuffered) &&
                         target.write(bytes) == bytes.size() && target.commit();
    return written ? QString{} : target.errorString();
}

}  // namespace cortex::gui
