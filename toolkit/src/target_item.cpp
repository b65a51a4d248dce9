// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/target_item.hpp"

#include "cortex/core/command.hpp"

#include <cmath>

namespace cortex::toolkit {

// A value that was retained together with `targetGiven` is a target only if it was one.
void TargetItem::bind(Simplex& owner, std::string_view item) {
    name_ = item;
    values_ = owner.array<double>(item);
    given_ = owner.data<bool>("targetGiven");
    given_ = owner.hasValue(item) && (!owner.hasValue("targetGiven") || given_);
}

void TargetItem::show(std::size_t axis, double position) {
    if (!given_ && std::isfinite(position)) values_[axis] = position;
}

bool TargetItem::isGiven(Call& call) const {
    if (given_) return true;
    call.reject(Reason::State, (EventText{name_} << " was never set: set it first").view());
    return false;
}

}  // namespace cortex::toolkit
