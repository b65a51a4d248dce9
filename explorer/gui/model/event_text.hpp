// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/numbered_text.hpp"

#include <QString>
#include <string>
#include <string_view>
#include <vector>

// Texts of events with their numbers taken out: two that differ only in numbers are one row.
namespace cortex::gui {

// Whether events of this kind say what became of a command.
bool tellsOfCommand(const std::string& kind);

// Who sent a command, and on whose behalf. It refers to the text.
struct SenderParts {
    std::string_view tool;    // "cortex@desk.4711-5e1f0a"
    std::string_view person;  // "alice"; empty: the tool said none
};
SenderParts senderParts(std::string_view sender);

// "alice (cortex@desk.4711-5e1f0a): jog(…): Done" of "cortex@desk.4711-5e1f0a for alice: jog(…):
// Done". Any other text is as it was.
std::string personFirst(const std::string& text);
// "alice: jog(…): Done" of the same, where there is little room: the tool stands elsewhere.
std::string personAlone(const std::string& text);

QString rangeText(const NumberRange& range);  // "−2.1187 … −2.0951"; one value as it was written

// The words with those ranges in their places.
QString foldedText(const std::string& words, const std::vector<NumberRange>& ranges);

}  // namespace cortex::gui
