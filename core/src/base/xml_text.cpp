// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/xml_text.hpp"

namespace cortex {

std::string xmlAttribute(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                if (static_cast<unsigned char>(c) < 0x20) {
                    result += "&#" + std::to_string(static_cast<int>(c)) + ";";
                } else {
                    result += c;
                }
        }
    }
    return result;
}

}  // namespace cortex
