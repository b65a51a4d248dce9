// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/simplex.hpp"

#include <string>
#include <string_view>

namespace cortex::toolkit {

// Name of the item that a block works on, as its own text item says. Setup phase.
inline std::string itemName(Simplex& block, std::string_view item) {
    return std::string{block.data<const std::string_view>(item).get()};
}

// One number that a block writes, and what of it went out in the cycle before. An observation goes
// out as it was written.
class ScalarOutput {
public:
    ScalarOutput() = default;
    ScalarOutput(const OutputSimplex& output, std::string_view item)
        : value_{output.data<double>(item)},
          before_{output.type().role == Role::Observation ? output.data<const double>(item)
                                                          : output.accepted<double>(item)},
          taken_{output.taken()},
          observes_{output.type().role == Role::Observation} {}

    bool observes() const { return observes_; }

    double before() const CORTEX_REALTIME { return before_; }
    // How far it may move in this time: no way while no device takes it.
    double step(double rate, double seconds) const CORTEX_REALTIME {
        return taken_ ? rate * seconds : 0;
    }
    void write(double value) CORTEX_REALTIME { value_ = value; }

private:
    Data<double> value_;
    Data<const double> before_;
    Data<const bool> taken_;
    bool observes_ = false;
};

}  // namespace cortex::toolkit
