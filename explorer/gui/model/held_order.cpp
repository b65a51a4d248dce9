// SPDX-License-Identifier: Apache-2.0
#include "model/held_order.hpp"

namespace cortex::gui {

// A key may be there twice.
std::vector<int> HeldOrder::update(const std::vector<std::string>& now, bool held) {
    if (!held) keys_ = now;
    std::vector<int> places(keys_.size(), gone);
    for (std::size_t each = 0; each < now.size(); ++each) {
        std::size_t row = 0;
        while (row < keys_.size() && (keys_[row] != now[each] || places[row] != gone)) ++row;
        if (row == keys_.size()) {
            keys_.push_back(now[each]);
            places.push_back(gone);
        }
        places[row] = static_cast<int>(each);
    }
    return places;
}

}  // namespace cortex::gui
