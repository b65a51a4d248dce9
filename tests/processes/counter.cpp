// SPDX-License-Identifier: Apache-2.0
// A plug-in that counts its cycles, and goes on from where a restart found it.
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <cstdint>
#include <limits>
#include <string_view>

namespace {

class Counter final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        count_ = data<std::int64_t>("count");
        gain_ = data<const double>("gain");
        share_ = data<double>("share");
        // As a class would that does not ask hasValue().
        if (data<const std::string_view>("title").get() == "reset") count_ = 55;
    }
    // A gain above 5 makes the share no number, as a mistake in a real class would.
    void loopEnd(const cortex::Tick&) override {
        count_ += 1;
        share_ = gain_ > 5 ? std::numeric_limits<double>::quiet_NaN() : 0.25;
    }

    cortex::Data<std::int64_t> count_;
    cortex::Data<const double> gain_;
    cortex::Data<double> share_;
};

void addClasses(cortex::ClassRegistry& registry) { registry.add<Counter>("Counter"); }

}  // namespace

CORTEX_PLUGIN(addClasses, {"Counter", ""})
