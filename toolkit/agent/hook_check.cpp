// SPDX-License-Identifier: Apache-2.0
#include "hook_check.hpp"

#include "cortex/core/error.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>

#include <dlfcn.h>
#include <unistd.h>

namespace cortex::toolkit {

namespace {

constexpr const char* startedAnew = "CORTEX_HOOKS_ARE_CHECKED";  // set to what LD_PRELOAD was

std::filesystem::path checkerFile() {
#ifdef CORTEX_HOOK_CHECKER
    Dl_info info{};
    dladdr(reinterpret_cast<const void*>(&cs::blockStopSignals), &info);
    std::filesystem::path file = std::filesystem::absolute(info.dli_fname);
    file.replace_filename(CORTEX_HOOK_CHECKER);
    if (!std::filesystem::exists(file)) {
        throw Error("--check-hooks needs " + file.string() + ", which is not there; install it");
    }
    if (file.string().find_first_of(" :") != std::string::npos) {
        throw Error("--check-hooks: LD_PRELOAD takes no path with a blank or a colon, as in " +
                    file.string());
    }
    return file;
#else
    throw Error(
        "--check-hooks: this build has no hook checker; build with BUILD_SHARED_LIBS=ON and "
        "without CORTEX_SANITIZE");
#endif
}

// LD_BIND_NOW: no hook is the first to call a function, which the loader would then look for.
void startAnew(char** arguments) {
    if (std::getenv(startedAnew) != nullptr) {
        throw Error(
            "--check-hooks: the system did not preload the hook checker, as for a program with "
            "rights of its own");
    }
    const char* before = std::getenv("LD_PRELOAD");
    const std::string others = before == nullptr ? "" : before;
    const std::string all = checkerFile().string() + (others.empty() ? "" : ":" + others);
    setenv(startedAnew, others.c_str(), 1);
    setenv("LD_PRELOAD", all.c_str(), 1);
    setenv("LD_BIND_NOW", "1", 1);
    execv("/proc/self/exe", arguments);
    throw Error(std::string{"--check-hooks: the program cannot start anew: "} +
                std::strerror(errno));
}

}  // namespace

HookCheck::HookCheck(bool wanted, char** arguments) {
    if (!wanted) return;
    const auto find =
        reinterpret_cast<decltype(&cortexHookChecker)>(dlsym(RTLD_DEFAULT, "cortexHookChecker"));
    if (find == nullptr) startAnew(arguments);
    checker_ = find();
    if (const char* before = std::getenv(startedAnew)) {  // no program that this one starts has it
        setenv("LD_PRELOAD", before, 1);
        unsetenv(startedAnew);
        unsetenv("LD_BIND_NOW");
    }
}

void HookCheck::watch(cs::ClusterCS& cluster) {
    if (checker_ != nullptr) checker_->watch(cluster);
}

void HookCheck::look() {
    if (checker_ == nullptr) return;
    for (const cs::HookViolation& each : checker_->newViolations()) {
        // In one piece: the hooks of others may print meanwhile.
        std::cerr << "hook check: " + each.text() + "\n" << std::flush;
    }
}

bool HookCheck::printEnd() {
    if (checker_ == nullptr) return false;
    const auto found = checker_->violations();
    std::cout << "hook check: "
              << (found.empty() ? "no violation\n"
                                : "violations at " + std::to_string(found.size()) + " places\n");
    for (const cs::HookViolation& each : found) {
        std::cout << "  " << each.count << (each.count == 1 ? " time: " : " times: ") << each.text()
                  << '\n';
    }
    const std::string reason = checker_->withoutPageFaults();
    if (!reason.empty()) std::cout << "  page faults were not looked at: " << reason << '\n';
    std::cout << std::flush;
    return !found.empty();
}

}  // namespace cortex::toolkit
