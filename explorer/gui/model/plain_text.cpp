// SPDX-License-Identifier: Apache-2.0
#include "model/plain_text.hpp"

#include <QDateTime>
#include <QLocale>
#include <QStringList>
#include <QTimeZone>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr int tipColumns = 90;
constexpr QChar unseenSign{0xFFFD};

// Letters beyond the first plane come in two halves.
bool isSeen(QChar each) { return each.isPrint() || each.isSurrogate(); }

}  // namespace

QString plainText(const std::string& text) {
    QString result = QString::fromStdString(text);
    for (QChar& c : result) {
        if (!c.isPrint()) c = ' ';
    }
    return result;
}

bool isPlain(const QString& text) { return std::ranges::all_of(text, isSeen); }

QString isolatedText(const std::string& text) {
    const QString plain = visibleText(QString::fromStdString(text));
    const bool turns = std::ranges::any_of(plain, [](QChar each) {
        return each.direction() == QChar::DirR || each.direction() == QChar::DirAL;
    });
    return turns ? QChar{0x2068} + plain + QChar{0x2069} : plain;
}

QString visibleText(const QString& text) {
    QString visible = text;
    std::ranges::replace_if(visible, [](QChar each) { return !isSeen(each); }, unseenSign);
    return visible;
}

QString meantText(const QString& visible, const QString& original) {
    const QString signs = visibleText(original);
    if (visible.count(unseenSign) != signs.count(unseenSign)) return visible;
    QString meant = visible;
    int from = -1;
    for (QChar& each : meant) {
        if (each != unseenSign) continue;
        from = signs.indexOf(unseenSign, from + 1);
        each = original[from];
    }
    return meant;
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
