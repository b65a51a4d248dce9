// SPDX-License-Identifier: Apache-2.0
#include "model/shown_time.hpp"

#include <QDateTime>

namespace cortex::gui {

namespace {

bool local = false;

QDateTime timeAt(std::int64_t utc, bool here) {
    return QDateTime::fromMSecsSinceEpoch(utc / 1'000'000, here ? Qt::LocalTime : Qt::UTC);
}

}  // namespace

void showLocalTime(bool wanted) { local = wanted; }

bool showsLocalTime() { return local; }

QString localZoneName(std::int64_t utc) {
    const QString name = timeAt(utc, true).timeZoneAbbreviation();
    const bool number = name.startsWith('+') || name.startsWith('-');  // of zones without a name
    return number ? QStringLiteral("UTC") + name : name;
}

QString zoneName(std::int64_t utc) { return local ? localZoneName(utc) : QStringLiteral("UTC"); }

std::int64_t zoneOffset(std::int64_t utc) { return timeAt(utc, local).offsetFromUtc(); }

QString shownTimeText(std::int64_t utc, const char* format) {
    return timeAt(utc, local).toString(QString::fromLatin1(format));
}

QString timeAndZone(std::int64_t utc, const char* format) {
    return shownTimeText(utc, format) + ' ' + zoneName(utc);
}

}  // namespace cortex::gui
