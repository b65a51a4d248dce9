// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/proposed_settings.hpp"
#include "cortex/core/simplex.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace cortex::toolkit {

// An item that says where axes are to go, in rad or m. It is a target once a `set`, a file or the
// command line gave it a value since the start of the agent, and the item `targetGiven` tells that.
// Until then it shows where the axes are, and whatever leads there is to be refused. A class that
// derives from its owner and overrides a hook calls that of the base, or nothing is ever given.
class TargetItem {
public:
    // In populate().
    void bind(Simplex& owner, std::string_view item);
    // In settingsProposed() and settingsChanged() of the owner.
    void propose(const ProposedSettings& proposed) CORTEX_REALTIME {
        isProposed_ = proposed.names(values_);
    }
    void settle() CORTEX_REALTIME { given_ = given_ || isProposed_; }
    // In each cycle: what an axis shows as long as nothing was given.
    void show(std::size_t axis, double position) CORTEX_REALTIME;
    // In a command. Otherwise the call is rejected.
    bool isGiven(Call& call) const CORTEX_REALTIME;

    std::size_t size() const { return values_.size(); }
    double operator[](std::size_t axis) const { return values_[axis]; }
    std::span<const double> values() const { return values_; }

private:
    std::string_view name_;
    std::span<double> values_;
    Data<bool> given_;
    bool isProposed_ = false;
};

}  // namespace cortex::toolkit
