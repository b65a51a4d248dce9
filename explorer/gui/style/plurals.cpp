// SPDX-License-Identifier: Apache-2.0
#include "style/plurals.hpp"

#include <algorithm>
#include <string_view>

namespace cortex::gui {

QString Plurals::translate(const char* /*context*/, const char* text, const char* /*remark*/,
                           int count) const {
    if (count != 1) return {};
    const auto found = std::ranges::find_if(
        plurals, [&](const auto& each) { return std::string_view{each.second} == text; });
    return found == plurals.end() ? QString{} : QString::fromUtf8(found->first);
}

}  // namespace cortex::gui
