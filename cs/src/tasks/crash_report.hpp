// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/structure.hpp"

#include "tasks/hook.hpp"

#include <csetjmp>
#include <string>

namespace cortex::cs {

// Where a thread goes on after code of a plug-in has called exit(): see refused_exit.hpp.
struct Escape {
    std::jmp_buf place;
};

// Once on each loop thread, before its first cycle: a crash on this thread from now on prints the
// path of the simplex and the hook to stderr, on a stack of its own. Then the process ends by the
// same signal, or by the handler that the program had for it. All arguments outlive the thread.
void reportCrashesOfThisThread(const Structure& structure, const Position& position,
                               Escape& escape);

// What a thread does outside of hooks, while the object lives; the same is printed of a crash.
class PhaseOfThread {
public:
    explicit PhaseOfThread(const char* what, Escape* escape = nullptr);  // both outlive it
    ~PhaseOfThread();
    PhaseOfThread(const PhaseOfThread&) = delete;
    PhaseOfThread& operator=(const PhaseOfThread&) = delete;

private:
    const char* before_;
    Escape* escapeBefore_;
};

// What this thread runs, while it runs a hook. May be called in a handler of a signal.
struct HookOfThread {
    const SimplexInfo* simplex = nullptr;  // none: no hook
    Hook hook = Hook::None;
};
HookOfThread hookOfThisThread() noexcept;

// Whether this thread is one that runs hooks.
bool isLoopThread();

// "stateActive of /arm", the phase, or "a thread of its own".
std::string placeOfThread();
// Null: there is no way out of where this thread is now.
Escape* escapeOfThread();
// The file of the plug-in that this thread runs code of or was called by; null: of none.
const char* pluginOfThread();

}  // namespace cortex::cs
