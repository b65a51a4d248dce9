// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cortex::cli {

// The words of a line: with blanks between them, '…' and "…" around blanks, \ before one character,
// and # in front of a remark. None: a quote does not end.
std::optional<std::vector<std::string>> splitWords(const std::string& line);

}  // namespace cortex::cli
