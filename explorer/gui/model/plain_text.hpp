// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <cstdint>
#include <string>

// Texts that come from outside, and texts of the screen that many views share.
namespace cortex::gui {

// In one line: control characters, line breaks too, are blanks.
QString plainText(const std::string& text);

// For a tool tip: lines that are too long for a screen are broken at blanks.
QString tipText(const QString& text);

QString utcText(std::int64_t utc, const char* format);  // UTC ns, such as "HH:mm:ss.zzz"
QString countText(std::uint64_t count);                 // "1,652"

}  // namespace cortex::gui
