// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <cstdint>
#include <string>

// Texts that come from outside, and texts of the screen that many views share.
namespace cortex::gui {

// In one line: control characters, line breaks too, are blanks.
QString plainText(const std::string& text);

// Whether it is shown as it is written: nothing in it is unseen, or turns what stands beside it.
bool isPlain(const QString& text);

// A value among other words, whose order it does not change, also where it is from right to left.
QString isolatedText(const std::string& text);

// What is unseen or turns what stands beside it is shown as one sign each, to be edited among it;
// and the text that was meant, as long as none of these signs was added or taken away.
QString visibleText(const QString& text);
QString meantText(const QString& visible, const QString& original);

// For a tool tip: lines that are too long for a screen are broken at blanks.
QString tipText(const QString& text);

QString utcText(std::int64_t utc, const char* format);  // UTC ns, such as "HH:mm:ss.zzz"
QString countText(std::uint64_t count);                 // "1,652"

}  // namespace cortex::gui
