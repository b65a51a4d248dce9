// SPDX-License-Identifier: Apache-2.0
// Compiled once for each mistake, as core/must_not_compile.cpp is.
#include "cortex/cs/simplex_cs.hpp"

namespace cortex::cs {

class Hooked final : public SimplexCS {
#if defined(FORGET_OVERRIDE)
    void stateActive(const Tick&) {}
#elif defined(MISSPELL_A_HOOK)
    void stateActiv(const Tick&) override {}
#else
    void stateActive(const Tick&) override {}
#endif
};

}  // namespace cortex::cs
