// SPDX-License-Identifier: Apache-2.0
#include "mujoco_errors.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include <mujoco/mujoco.h>

namespace cortex::physics {
namespace {

struct Guard {
    std::jmp_buf back;
    MujocoText* error;
};

// Of the threads that are in guarded(). In the memory that each thread has from its begin: other
// thread-local memory of a plug-in is allocated when it is first used, which may be in a tick.
[[gnu::tls_model("initial-exec")]] thread_local Guard* guard = nullptr;

void (*errorBefore)(const char*) = nullptr;
void (*warningBefore)(const char*) = nullptr;

void onWarning(const char* text) {
    if (guard != nullptr) return;
    if (warningBefore != nullptr) return warningBefore(text);
    std::fprintf(stderr, "MuJoCo warns: %s\n", text);
}

// MuJoCo goes on as if nothing was where this returns. It is C, and has no way for an exception.
void onError(const char* text) {
    if (guard == nullptr) {
        if (errorBefore != nullptr) return errorBefore(text);
        std::fprintf(stderr, "MuJoCo fails: %s\n", text);
        std::abort();
    }
    std::snprintf(guard->error->data(), guard->error->size(), "%s", text);
    std::longjmp(guard->back, 1);  // NOLINT(cert-err52-cpp)
}

}  // namespace

void handleMujocoErrors() {
    static std::once_flag once;
    std::call_once(once, [] {
        errorBefore = mju_user_error;
        warningBefore = mju_user_warning;
        mju_user_error = onError;
        mju_user_warning = onWarning;
    });
}

bool guarded(void (*work)(void*), void* argument, MujocoText& error) {
    Guard own;
    own.error = &error;
    Guard* const outer = guard;
    guard = &own;
    if (setjmp(own.back) == 0) {  // NOLINT(cert-err52-cpp)
        work(argument);
        guard = outer;
        return true;
    }
    guard = outer;
    return false;
}

}  // namespace cortex::physics
