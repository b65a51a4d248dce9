// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifndef Q_MOC_RUN  // which cannot read it
#include <compare>
#endif
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cortex::gui {

// One number, truth or text of one agent that is recorded.
struct RecordedItem {
    std::string agent, path, item;
    std::size_t element = 0;  // of an array

    auto operator<=>(const RecordedItem&) const = default;
};

// "/drives/4.position" or "/arm.pose[3]", without an agent. None: it is no item.
std::optional<RecordedItem> recordedItem(std::string_view text);

std::string textOf(const RecordedItem& item);  // the same again; "[0]" is left out

}  // namespace cortex::gui
