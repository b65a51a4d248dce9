// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cortex::cli {

// The words of a line: with blanks between them, '…' and "…" around blanks, \ before one character,
// and # in front of a remark. None: a quote does not end.
std::optional<std::vector<std::string>> splitWords(const std::string& line);

// Where the last word of a line begins, as it was typed and may go on; its length if none is begun.
std::size_t lastWord(const std::string& line);

// A text as one word of a line, in "…" where it needs them.
std::string asWord(const std::string& text);
// The same as it may go on from a beginning that was typed: in its quotes, or with \.
std::string asWord(const std::string& text, const std::string& begun);

}  // namespace cortex::cli
