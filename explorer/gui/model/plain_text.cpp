// SPDX-License-Identifier: Apache-2.0
#include "model/plain_text.hpp"

#include <QDateTime>
#include <QLocale>
#include <QStringList>
#include <QTimeZone>

namespace cortex::gui {

namespace {

constexpr int tipColumns = 90;

}  // namespace

QString plainText(const std::string& text) {
    QString result = QString::fromStdString(text);
    for (QChar& c : result) {
        if (!c.isPrint()) c = ' ';
    }
    return result;
}

QString tipText(const QString& text) {
    QStringList lines;
    for (const QString& paragraph : text.split('\n')) {
        QString line;
        for (const QString& word : paragraph.split(' ')) {
            if (!line.isEmpty() && line.size() + 1 + word.size() > tipColumns) {
                lines << line;
                line = word;
            } else {
                line += line.isEmpty() ? word : ' ' + word;
            }
        }
        lines << line;
    }
    return lines.join('\n');
}

QString utcText(std::int64_t utc, const char* format) {
    return QDateTime::fromMSecsSinceEpoch(utc / 1'000'000, QTimeZone::utc())
        .toString(QString::fromLatin1(format));
}

QString countText(std::uint64_t count) {
    return QLocale{QLocale::English}.toString(static_cast<qulonglong>(count));
}

}  // namespace cortex::gui
