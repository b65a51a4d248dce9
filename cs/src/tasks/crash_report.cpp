// SPDX-License-Identifier: Apache-2.0
#include "tasks/crash_report.hpp"

#include <array>
#include <csignal>
#include <memory>
#include <string_view>

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

void printPlace(std::string_view signal) {
    const std::uint32_t simplex = positionOfThread->simplex.load(std::memory_order_relaxed);
    if (simplex == noSimplex) return;
    print("cortex: ");
    print(signal);
    print(" in ");
    print(name(positionOfThread->hook.load(std::memory_order_relaxed)));
    print(" of ");
    print(structureOfThread->simplexes[simplex].path);
    print("; the process ends\n");
}

// A fault of the processor happens again when this returns; what was sent is sent again.
void report(int signal, siginfo_t* info, void* /*context*/) {
    for (const Crash& crash : crashes) {
        if (crash.signal != signal) continue;
        if (positionOfThread != nullptr) printPlace(crash.name);
        sigaction(signal, &crash.before, nullptr);
    }
    if (info->si_code <= 0) raise(signal);
}

bool installHandlers() {
    struct sigaction action{};
    action.sa_sigaction = report;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (Crash& crash : crashes) sigaction(crash.signal, &action, &crash.before);
    return true;
}

}  // namespace

void reportCrashesOfThisThread(const Structure& structure, const Position& position) {
    static const bool installed = installHandlers();
    static_cast<void>(installed);
    static const thread_local CrashStack stack;
    structureOfThread = &structure;
    positionOfThread = &position;
}

bool isLoopThread() { return positionOfThread != nullptr; }

}  // namespace cortex::cs
