// SPDX-License-Identifier: Apache-2.0
#include "common/csv_cell.hpp"

#include <algorithm>

namespace cortex::common {

std::string csvCell(std::string_view text) {
    const auto needsQuotes = [](unsigned char each) {
        return each <= ' ' || each == ',' || each == '"' || each == 0x7fU;
    };
    if (std::ranges::none_of(text, needsQuotes)) return std::string{text};
    std::string cell = "\"";
    for (const char each : text) {
        if (each == '"') cell += '"';
        cell += each;
    }
    return cell + '"';
}

}  // namespace cortex::common
