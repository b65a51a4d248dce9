// SPDX-License-Identifier: Apache-2.0
// A plug-in that knows a type Axis and nothing of what other agents make of it.
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <span>
#include <vector>

namespace {

class AxisReader final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        for (const auto& axis : inputs("axes")) axes_.push_back(axis.data<double>("position"));
        seen_ = array<double>("seen");
    }
    void loopEnd(const cortex::Tick&) override {
        for (std::size_t i = 0; i < axes_.size(); ++i) seen_[i] = axes_[i];
    }

    std::vector<cortex::Data<const double>> axes_;
    std::span<double> seen_;
};

void addClasses(cortex::ClassRegistry& registry) { registry.add<AxisReader>("AxisReader"); }

}  // namespace

CORTEX_PLUGIN(addClasses, {"AxisReader", ""})
