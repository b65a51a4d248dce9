// SPDX-License-Identifier: Apache-2.0
#include "common/to_its_sender.hpp"

#include <string_view>

namespace cortex::common {

std::string toItsSender(const std::string& why) {
    constexpr std::string_view begin = "withdrawn by a later ", end = " of its sender";
    const bool known =
        why.starts_with(begin) && why.ends_with(end) && why.size() > begin.size() + end.size();
    if (!known) return why;
    const std::size_t length = why.size() - begin.size() - end.size();
    return "withdrawn by your " + why.substr(begin.size(), length);
}

}  // namespace cortex::common
