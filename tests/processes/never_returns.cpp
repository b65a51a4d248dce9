// SPDX-License-Identifier: Apache-2.0
// A plug-in whose simplex does not come back from where its file says: its constructor, populate(),
// its destructor, or never.
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <cstdlib>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace {

void hang() {
    for (;;) pause();
}

bool isAsked(std::string_view where) {
    const char* asked = std::getenv("NEVER_RETURNS_FROM");
    return asked != nullptr && asked == where;
}

class NeverReturns final : public cortex::cs::SimplexCS {
public:
    explicit NeverReturns(Identity identity) : SimplexCS{std::move(identity)} {
        if (isAsked("constructor")) hang();
    }

    ~NeverReturns() override {
        if (isAsked("destructor")) hang();
    }

private:
    void populate() override {
        if (isAsked("populate")) hang();
    }
};

void addClasses(cortex::ClassRegistry& registry) { registry.add<NeverReturns>("NeverReturns"); }

}  // namespace

CORTEX_PLUGIN(addClasses, {"NeverReturns", ""})
