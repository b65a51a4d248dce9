// SPDX-License-Identifier: Apache-2.0
#include "common/needed_control.hpp"

#include "cortex/comms/lease_client.hpp"
#include "cortex/core/path.hpp"

#include "common/image_items.hpp"

namespace cortex::common {

std::string withoutEnd(std::string_view prefix) {
    const std::string_view trimmed = withoutEndSlashes(prefix);
    return trimmed.empty() ? "/" : std::string{trimmed};
}

std::optional<std::string> neededControl(const std::string& path, bool ofAgent,
                                         std::string_view command, const DataItem* prefix,
                                         const comms::Mirror::Arguments& arguments) {
    if (comms::isFreeCommand(command)) return std::nullopt;
    if (!ofAgent || prefix == nullptr || prefix->kind != Kind::String) return path;
    const auto given = arguments.find("prefix");
    const auto text =
        firstOf<std::string>(given != arguments.end() ? given->second : prefix->initial);
    return text ? withoutEnd(*text) : path;
}

}  // namespace cortex::common
