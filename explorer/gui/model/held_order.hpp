// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cortex::gui {

// The order of the rows of a table. While somebody uses it, what comes stands at the end, and what
// goes leaves its row.
class HeldOrder {
public:
    static constexpr int gone = -1;

    // For each row the place in `now` of what it shows, or `gone`.
    std::vector<int> update(const std::vector<std::string>& now, bool held);
    const std::string& key(int row) const { return keys_[static_cast<std::size_t>(row)]; }

private:
    std::vector<std::string> keys_;
};

}  // namespace cortex::gui
