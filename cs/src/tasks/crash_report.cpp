// SPDX-License-Identifier: Apache-2.0
#include "tasks/crash_report.hpp"

#include "cortex/core/plugin_places.hpp"

#include <array>
#include <csignal>
#include <memory>
#include <string_view>

#include <execinfo.h>
#include <unistd.h>

namespace cortex::cs {

namespace {

struct Crash {
    int signal;
    std::string_view name;
    struct sigaction before;
};

// What the handler reads; it may call nothing that allocates or locks.
std::array<Crash, 5> crashes{Crash{SIGSEGV, "SIGSEGV", {}}, Crash{SIGFPE, "SIGFPE", {}},
                             Crash{SIGBUS, "SIGBUS", {}}, Crash{SIGILL, "SIGILL", {}},
                             Crash{SIGABRT, "SIGABRT", {}}};

// What this thread runs. Bound at start-up of the program: reading it never allocates.
[[gnu::tls_model("initial-exec")]] thread_local const Structure* structureOfThread = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local const Position* positionOfThread = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local const char* phaseOfThread = nullptr;
[[gnu::tls_model("initial-exec")]] thread_local Escape* escapeNow = nullptr;

// An overflow of the stack leaves none for the handler.
class CrashStack {
public:
    CrashStack() {
        stack_t present{};
        sigaltstack(nullptr, &present);
        if ((present.ss_flags & SS_DISABLE) == 0) return;  // a sanitizer's or the program's
        memory_ = std::make_unique<std::byte[]>(size);
        const stack_t own{.ss_sp = memory_.get(), .ss_flags = 0, .ss_size = size};
        sigaltstack(&own, nullptr);
    }
    ~CrashStack() {
        if (memory_ == nullptr) return;
        const stack_t none{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
        sigaltstack(&none, nullptr);
    }
    CrashStack(const CrashStack&) = delete;
    CrashStack& operator=(const CrashStack&) = delete;

private:
    static constexpr std::size_t size = 65'536;  // registers of AVX-512, and a sanitizer's handler
    std::unique_ptr<std::byte[]> memory_;
};

void print(std::string_view text) {
    if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nothing is left to do
}

// noSimplex: in no hook.
std::uint32_t simplexOfThread() {
    return positionOfThread == nullptr ? noSimplex
                                       : positionOfThread->simplex.load(std::memory_order_relaxed);
}

void printHook() {
    print(name(positionOfThread->hook.load(std::memory_order_relaxed)));
    print(" of ");
    print(structureOfThread->simplexes[simplexOfThread()].path);
}

// The place first: to look for the plug-in may crash again, where the stack is broken.
void printPlace(std::string_view signal) {
    const bool inHook = simplexOfThread() != noSimplex;
    const bool known = inHook || phaseOfThread != nullptr;
    if (known) {
        print("cortex: ");
        print(signal);
        print(" in ");
        inHook ? printHook() : print(phaseOfThread);
    }
    const char* const plugin = pluginOfThread();
    if (plugin != nullptr) {
        if (!known) {
            print("cortex: ");
            print(signal);
        }
        print(known ? " (plug-in " : " in a thread of plug-in ");
        print(plugin);
        if (known) print(")");
    }
    if (known || plugin != nullptr) print("; the process ends\n");
}

// A fault of the processor happens again when this returns; what was sent is sent again.
void report(int signal, siginfo_t* info, void* /*context*/) {
    for (const Crash& crash : crashes) {
        if (crash.signal != signal) continue;
        printPlace(crash.name);
        sigaction(signal, &crash.before, nullptr);
    }
    if (info->si_code <= 0) raise(signal);
}

bool installHandlers() {
    void* first = nullptr;
    backtrace(&first, 1);  // loads what it needs, which a handler may not
    struct sigaction action{};
    action.sa_sigaction = report;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (Crash& crash : crashes) sigaction(crash.signal, &action, &crash.before);
    return true;
}

// A stack that overflows leaves no room for the handler.
void prepareThisThread() {
    static const bool installed = installHandlers();
    static_cast<void>(installed);
    static const thread_local CrashStack stack;
}

}  // namespace

void reportCrashesOfThisThread(const Structure& structure, const Position& position,
                               Escape& escapeFromHooks) {
    prepareThisThread();
    structureOfThread = &structure;
    positionOfThread = &position;
    escapeNow = &escapeFromHooks;
}

PhaseOfThread::PhaseOfThread(const char* what, Escape* escapeFromIt)
    : before_{phaseOfThread}, escapeBefore_{escapeNow} {
    prepareThisThread();
    phaseOfThread = what;
    escapeNow = escapeFromIt;
}

PhaseOfThread::~PhaseOfThread() {
    phaseOfThread = before_;
    escapeNow = escapeBefore_;
}

HookOfThread hookOfThisThread() noexcept {
    const std::uint32_t simplex = simplexOfThread();
    if (simplex == noSimplex) return {};
    return {&structureOfThread->simplexes[simplex],
            positionOfThread->hook.load(std::memory_order_relaxed)};
}

bool isLoopThread() { return positionOfThread != nullptr; }

std::string placeOfThread() {
    const std::uint32_t simplex = simplexOfThread();
    if (simplex == noSimplex)
        return phaseOfThread != nullptr ? phaseOfThread : "a thread of its own";
    return std::string{name(positionOfThread->hook.load(std::memory_order_relaxed))} + " of " +
           structureOfThread->simplexes[simplex].path;
}

Escape* escapeOfThread() {
    return isLoopThread() && simplexOfThread() == noSimplex ? nullptr : escapeNow;
}

const char* pluginOfThread() {
    std::array<void*, 64> frames{};
    const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
    for (int i = 0; i < count; ++i) {
        if (const char* plugin = pluginAt(frames[static_cast<std::size_t>(i)])) return plugin;
    }
    return nullptr;
}

}  // namespace cortex::cs
