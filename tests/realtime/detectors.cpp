// SPDX-License-Identifier: Apache-2.0
#include "realtime/detectors.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <sstream>
#include <tuple>
#include <vector>

#include <dlfcn.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

namespace cortex::test {

namespace {

// Initial-exec: reading it never allocates.
__attribute__((tls_model("initial-exec"))) thread_local bool inTick = false;

std::atomic<std::uint64_t> allocations{0}, locks{0}, systemCalls{0}, futexCalls{0};
std::atomic<long> firstSystemCall{-1};
std::atomic<int> watchedCount{0};
std::array<std::atomic<pid_t>, 64> watchedThreads{};

void countAllocation() {
    if (inTick) allocations.fetch_add(1, std::memory_order_relaxed);
}

void countLock() {
    if (inTick) locks.fetch_add(1, std::memory_order_relaxed);
}

// A system call from a place of its own, cortexAfterCall, which the filter knows and lets pass.
#if defined(__x86_64__)
asm(R"(
    .pushsection .text
    .globl cortexCall, cortexAfterCall
cortexCall:
    movq %rdi, %rax
    movq %rsi, %rdi
    movq %rdx, %rsi
    movq %rcx, %rdx
    movq %r8, %r10
    movq %r9, %r8
    movq 8(%rsp), %r9
    syscall
cortexAfterCall:
    ret
    .popsection
)");
#elif defined(__aarch64__)
asm(R"(
    .pushsection .text
    .globl cortexCall, cortexAfterCall
cortexCall:
    mov x8, x0
    mov x0, x1
    mov x1, x2
    mov x2, x3
    mov x3, x4
    mov x4, x5
    mov x5, x6
    svc #0
cortexAfterCall:
    ret
    .popsection
)");
#endif
extern "C" long cortexCall(long number, long, long, long, long, long, long);
extern "C" const char cortexAfterCall[];

// What the kernel returns: in a tick to a futex call, which is counted, and outside of it to any
// (a thread that ends gives its stack back). Another call in a tick is an offence, and not made.
long resultOf(long number, const std::array<long, 6>& arguments) {
    if (inTick && number != SYS_futex) {
        systemCalls.fetch_add(1);
        long none = -1;
        firstSystemCall.compare_exchange_strong(none, number);
        return -ENOSYS;
    }
    if (inTick) futexCalls.fetch_add(1, std::memory_order_relaxed);
    return std::apply([number](auto... each) { return cortexCall(number, each...); }, arguments);
}

void onTrappedCall(int, siginfo_t* info, void* context) {
    auto& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    const auto& registers = machine.gregs;
    machine.gregs[REG_RAX] =
        resultOf(info->si_syscall, {registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
                                    registers[REG_R10], registers[REG_R8], registers[REG_R9]});
#elif defined(__aarch64__)
    std::array<long, 6> arguments{};
    std::copy_n(machine.regs, arguments.size(), arguments.begin());
    machine.regs[0] = static_cast<std::uint64_t>(resultOf(info->si_syscall, arguments));
#endif
}

void installFilter() {
    struct sigaction action{};
    action.sa_sigaction = onTrappedCall;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    sigaction(SIGSYS, &action, nullptr);

    constexpr std::array allowed{SYS_clock_nanosleep, SYS_clock_gettime, SYS_rt_sigreturn, SYS_exit,
                                 SYS_exit_group};
    // Lower and upper half of the address (of a machine that is little endian).
    const auto address = reinterpret_cast<std::uint64_t>(cortexAfterCall);
    constexpr std::size_t place = offsetof(seccomp_data, instruction_pointer);
    std::vector<sock_filter> program;
    program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, place));
    program.push_back(
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(address), 0, 3));
    program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, place + 4));
    program.push_back(
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(address >> 32U), 0, 1));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)));
    for (const long number : allowed) {
        program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 1));
        program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    }
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP));
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) {
        std::perror("seccomp");
        std::abort();
    }
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

std::string Offences::text() const {
    std::ostringstream text;
    text << allocations << " allocations, " << locks << " locks, " << systemCalls
         << " system calls, " << futexCalls << " futex calls";
    if (firstSystemCall >= 0) text << " (first: number " << firstSystemCall << ")";
    return text.str();
}

void watchThisThread() {
    const int index = watchedCount.fetch_add(1);
    watchedThreads.at(static_cast<std::size_t>(index)).store(gettid());
    installFilter();
}

void enterTick() { inTick = true; }
void leaveTick() { inTick = false; }

Offences offences() {
    return {allocations.load(), locks.load(), systemCalls.load(), futexCalls.load(),
            firstSystemCall.load()};
}

void resetOffences() {
    allocations = 0;
    locks = 0;
    systemCalls = 0;
    futexCalls = 0;
    firstSystemCall = -1;
    watchedCount = 0;
    for (auto& thread : watchedThreads) thread = 0;
}

std::uint64_t pageFaults() {
    std::uint64_t sum = 0;
    for (int i = 0; i < watchedCount.load(); ++i) {
        std::ifstream file{"/proc/self/task/" +
                           std::to_string(watchedThreads.at(static_cast<std::size_t>(i)).load()) +
                           "/stat"};
        std::string line;
        std::getline(file, line);
        const std::size_t afterName = line.rfind(')');
        if (afterName == std::string::npos) continue;
        std::istringstream fields{line.substr(afterName + 2)};
        // state ppid pgrp session tty tpgid flags minflt cminflt majflt
        std::string field;
        for (int skipped = 0; skipped < 7; ++skipped) fields >> field;
        std::uint64_t minor = 0;
        std::uint64_t ofChildren = 0;
        std::uint64_t major = 0;
        fields >> minor >> ofChildren >> major;
        sum += minor + major;
    }
    return sum;
}

}  // namespace cortex::test

// --- interposed functions ------------------------------------------------------------------------

using cortex::test::countAllocation;
using cortex::test::countLock;

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    countAllocation();
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    countAllocation();
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    countAllocation();
    return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    countAllocation();
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    countAllocation();
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    countAllocation();
    *memory = __libc_memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
    countAllocation();
    __libc_free(memory);
}

#define CORTEX_INTERPOSE_LOCK(name, Argument)                                       \
    int name(Argument* argument) {                                                  \
        countLock();                                                                \
        static const auto original = cortex::test::next<int (*)(Argument*)>(#name); \
        return original(argument);                                                  \
    }

CORTEX_INTERPOSE_LOCK(pthread_mutex_lock, pthread_mutex_t)
CORTEX_INTERPOSE_LOCK(pthread_mutex_trylock, pthread_mutex_t)
CORTEX_INTERPOSE_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
CORTEX_INTERPOSE_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
CORTEX_INTERPOSE_LOCK(pthread_cond_signal, pthread_cond_t)
CORTEX_INTERPOSE_LOCK(pthread_cond_broadcast, pthread_cond_t)

}  // extern "C"
