// SPDX-License-Identifier: Apache-2.0
#include "text/words.hpp"

namespace cortex::cli {

std::optional<std::vector<std::string>> splitWords(const std::string& line) {
    std::vector<std::string> words;
    bool inWord = false;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        const bool blank = c == ' ' || c == '\t' || c == '\r';
        if (quote == 0 && (blank || (c == '#' && !inWord))) {
            if (c == '#') break;
            inWord = false;
            continue;
        }
        if (!inWord) words.emplace_back();
        inWord = true;
        if (c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
        } else if (c == '\\' && quote != '\'' && i + 1 < line.size()) {
            words.back() += line[++i];
        } else {
            words.back() += c;
        }
    }
    if (quote != 0) return {};
    return words;
}

}  // namespace cortex::cli
