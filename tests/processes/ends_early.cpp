// SPDX-License-Identifier: Apache-2.0
// A plug-in that ends the process, crashes or has no stack left, where ENDS_EARLY says:
// "exit populate".
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace {

int deeper(const volatile char* above) {
    volatile char room[4096];
    room[0] = *above;
    if (*above == '?') return 0;
    return deeper(room) + room[0];
}

void endIf(std::string_view here) {
    const char* asked = std::getenv("ENDS_EARLY");
    const std::string_view text = asked != nullptr ? asked : "";
    if (!text.ends_with(here)) return;
    const std::string alive = "overhead";  // its destructor does not run, so it has no memory
    if (text.starts_with("exit")) std::exit(static_cast<int>(alive.size() % 7));
    if (text.starts_with("deeper")) std::exit(deeper(text.data()));
    std::raise(SIGSEGV);
}

[[maybe_unused]] const bool loaded = [] {
    endIf("load");
    return true;
}();

class NeverReturns final : public cortex::cs::SimplexCS {
public:
    explicit NeverReturns(Identity identity) : SimplexCS{std::move(identity)} {
        endIf("constructor");
    }

private:
    void populate() override { endIf("populate"); }
    void stateStandby(const cortex::Tick& tick) override {
        if (tick.cycle == 3) endIf("hook");
        if (tick.cycle == 3) std::thread{[] { endIf("thread"); }}.detach();
    }
};

void addClasses(cortex::ClassRegistry& registry) { registry.add<NeverReturns>("NeverReturns"); }

}  // namespace

CORTEX_PLUGIN(addClasses, {"NeverReturns", ""})
