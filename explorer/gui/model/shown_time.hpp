// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <cstdint>

// In which zone the window shows times: UTC, or that of this computer. One for the program; GUI
// thread. Files are in UTC, whatever is shown.
namespace cortex::gui {

void showLocalTime(bool wanted);
bool showsLocalTime();

// What the zone is called at a moment (UTC ns): "UTC", "CET".
QString zoneName(std::int64_t utc);
QString localZoneName(std::int64_t utc);
std::int64_t zoneOffset(std::int64_t utc);  // seconds that are added to UTC

QString shownTimeText(std::int64_t utc, const char* format);  // "HH:mm:ss.zzz"
QString timeAndZone(std::int64_t utc, const char* format);    // "12:05:07 UTC"

}  // namespace cortex::gui
