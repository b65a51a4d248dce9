// SPDX-License-Identifier: Apache-2.0
// The exit() that plug-ins call, so that none of them can end the process past the shutdown.
#include "cortex/cs/cluster_cs.hpp"

#include <cstdlib>

#include <dlfcn.h>

extern "C" __attribute__((visibility("default"))) void exit(int code) noexcept {
    cortex::cs::refuseExit(code);
    using Exit = void (*)(int);
    const auto ofTheSystem = reinterpret_cast<Exit>(dlsym(RTLD_NEXT, "exit"));
    ofTheSystem(code);
    std::abort();  // never reached
}
