// SPDX-License-Identifier: Apache-2.0
// A plug-in that counts its cycles, and goes on from where a restart found it.
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <cstdint>

namespace {

class Counter final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override { count_ = data<std::int64_t>("count"); }
    void loopEnd(const cortex::Tick&) override { count_ += 1; }

    cortex::Data<std::int64_t> count_;
};

void addClasses(cortex::ClassRegistry& registry) { registry.add<Counter>("Counter"); }

}  // namespace

CORTEX_PLUGIN(addClasses, {"Counter", ""})
