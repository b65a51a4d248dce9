// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

namespace cortex::gui {

// Numbers in names count as numbers, so that w2 stands before w10; otherwise by letters.
struct NaturalOrder {
    using is_transparent = void;  // NOLINT(readability-identifier-naming): a name of the library

    bool operator()(std::string_view a, std::string_view b) const {
        const std::string_view wholeA = a, wholeB = b;
        while (!a.empty() && !b.empty()) {
            const std::string_view x = piece(a), y = piece(b);
            if (isDigit(x.front()) && isDigit(y.front())) {
                const std::string_view left = plain(x), right = plain(y);
                if (left.size() != right.size()) return left.size() < right.size();
                if (left != right) return left < right;
            } else if (x != y) {
                return a < b;
            }
            a.remove_prefix(x.size());
            b.remove_prefix(y.size());
        }
        if (a.empty() != b.empty()) return a.empty();
        return wholeA < wholeB;  // 07 and 7
    }

private:
    static bool isDigit(char c) { return c >= '0' && c <= '9'; }
    // A run of digits, or everything up to the next one.
    static std::string_view piece(std::string_view text) {
        const bool digits = isDigit(text.front());
        const auto end = std::ranges::find_if(text, [&](char c) { return isDigit(c) != digits; });
        return text.substr(0, static_cast<std::size_t>(end - text.begin()));
    }
    static std::string_view plain(std::string_view digits) {
        return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
    }
};

}  // namespace cortex::gui
