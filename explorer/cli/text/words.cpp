// SPDX-License-Identifier: Apache-2.0
#include "text/words.hpp"

#include <string_view>

namespace cortex::cli {
namespace {

constexpr std::string_view special = " \t\r\"'\\";

std::string escaped(const std::string& text, std::string_view characters) {
    std::string result;
    for (const char c : text) {
        if (characters.find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return result;
}

}  // namespace

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

std::size_t lastWord(const std::string& line) {
    std::size_t begin = line.size();
    bool inWord = false;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        inWord = inWord && (quote != 0 || (c != ' ' && c != '\t'));
        if (!inWord && (c == ' ' || c == '\t')) continue;
        if (!inWord) begin = i;
        inWord = true;
        if (c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
        } else if (c == '\\' && quote != '\'') {
            ++i;
        }
    }
    return inWord ? begin : line.size();
}

std::string asWord(const std::string& text) {
    const bool isWord = escaped(text, special) == text && !text.empty() && text.front() != '#';
    return isWord ? text : '"' + escaped(text, "\"\\") + '"';
}

std::string asWord(const std::string& text, const std::string& begun) {
    if (begun.empty()) return asWord(text);
    if (begun.front() == '"') return '"' + escaped(text, "\"\\") + '"';
    if (begun.front() == '\'') return "'" + text + "'";  // another one in it would end it
    return escaped(text, special);
}

}  // namespace cortex::cli
