// SPDX-License-Identifier: Apache-2.0
#include "hook_checker/system_calls.hpp"

#include "cortex/core/error.hpp"

#include "hook_checker/offence.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

namespace cortex::cs {

namespace {

// A system call from a place of its own, cortexAfterCall, which the filter knows and lets pass.
#if defined(__x86_64__)
asm(R"(
    .pushsection .text
    .globl cortexCall, cortexAfterCall
    .hidden cortexCall, cortexAfterCall
    .type cortexCall, @function
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
    .hidden cortexCall, cortexAfterCall
    .type cortexCall, @function
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
#else
#error "the hook checker knows x86-64 and aarch64"
#endif
extern "C" [[gnu::visibility("hidden")]] long cortexCall(long number, long, long, long, long, long,
                                                         long);
extern "C" [[gnu::visibility("hidden")]] const char cortexAfterCall[];

using Arguments = std::array<long, 6>;

long makeCall(long number, const Arguments& arguments) {
    return std::apply([number](auto... each) { return cortexCall(number, each...); }, arguments);
}

// A new thread or process would have the filter without the stack or the handler that it needs.
long refusal(long number) {
    if (number == SYS_clone3) return -ENOSYS;  // who asks tries clone
    if (number == SYS_clone) return -EAGAIN;
#ifdef SYS_vfork
    if (number == SYS_fork || number == SYS_vfork) return -EAGAIN;
#endif
    return 0;
}

// What the kernel returns.
long resultOf(long number, const Arguments& arguments, ucontext_t& context) {
    const bool isOutput = (number == SYS_write || number == SYS_writev) &&
                          (arguments[0] == STDOUT_FILENO || arguments[0] == STDERR_FILENO);
    if (number == SYS_futex)
        noteFutex(number);
    else if (isOutput)
        note(Offence::Output, arguments[0], "write");
    else
        note(Offence::SystemCall, number, nullptr);
    if (const long refused = refusal(number); refused != 0) return refused;
    const long result = makeCall(number, arguments);
    // The mask that this handler returns to is the thread's; a trap while its signal is blocked
    // would end the process.
    if (number == SYS_rt_sigprocmask) {
        makeCall(number, {SIG_BLOCK, 0, reinterpret_cast<long>(&context.uc_sigmask), 8, 0, 0});
        sigdelset(&context.uc_sigmask, SIGSYS);
        sigdelset(&context.uc_sigmask, SIGTRAP);
    }
    return result;
}

void onTrappedCall(int /*signal*/, siginfo_t* info, void* place) {
    auto& context = *static_cast<ucontext_t*>(place);
    auto& machine = context.uc_mcontext;
#if defined(__x86_64__)
    const auto& registers = machine.gregs;
    machine.gregs[REG_RAX] = resultOf(info->si_syscall,
                                      {registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
                                       registers[REG_R10], registers[REG_R8], registers[REG_R9]},
                                      context);
#elif defined(__aarch64__)
    Arguments arguments{};
    std::copy_n(machine.regs, arguments.size(), arguments.begin());
    machine.regs[0] = static_cast<std::uint64_t>(resultOf(info->si_syscall, arguments, context));
#endif
}

void installHandler() {
    struct sigaction action{};
    action.sa_sigaction = onTrappedCall;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    sigaction(SIGSYS, &action, nullptr);
    sigset_t trapped;
    sigemptyset(&trapped);
    sigaddset(&trapped, SIGSYS);
    pthread_sigmask(SIG_UNBLOCK, &trapped, nullptr);
}

#define CORTEX_CALL(call) {SYS_##call, #call}
constexpr std::array<std::pair<long, const char*>, 46> names{{
    CORTEX_CALL(read),
    CORTEX_CALL(write),
    CORTEX_CALL(readv),
    CORTEX_CALL(writev),
    CORTEX_CALL(pread64),
    CORTEX_CALL(pwrite64),
    CORTEX_CALL(openat),
    CORTEX_CALL(close),
    CORTEX_CALL(lseek),
    CORTEX_CALL(fsync),
    CORTEX_CALL(fdatasync),
    CORTEX_CALL(newfstatat),
    CORTEX_CALL(fstat),
    CORTEX_CALL(unlinkat),
    CORTEX_CALL(ioctl),
    CORTEX_CALL(fcntl),
    CORTEX_CALL(mmap),
    CORTEX_CALL(munmap),
    CORTEX_CALL(mremap),
    CORTEX_CALL(mprotect),
    CORTEX_CALL(madvise),
    CORTEX_CALL(brk),
    CORTEX_CALL(futex),
    CORTEX_CALL(nanosleep),
    CORTEX_CALL(clock_nanosleep),
    CORTEX_CALL(sched_yield),
    CORTEX_CALL(socket),
    CORTEX_CALL(connect),
    CORTEX_CALL(sendto),
    CORTEX_CALL(recvfrom),
    CORTEX_CALL(sendmsg),
    CORTEX_CALL(recvmsg),
    CORTEX_CALL(ppoll),
    CORTEX_CALL(pselect6),
    CORTEX_CALL(epoll_pwait),
    CORTEX_CALL(rt_sigprocmask),
    CORTEX_CALL(rt_sigaction),
    CORTEX_CALL(kill),
    CORTEX_CALL(tgkill),
    CORTEX_CALL(clone),
    CORTEX_CALL(clone3),
    CORTEX_CALL(execve),
    CORTEX_CALL(getrandom),
    CORTEX_CALL(gettid),
    CORTEX_CALL(getpid),
    CORTEX_CALL(sched_setaffinity),
}};
#ifdef SYS_poll
constexpr std::array<std::pair<long, const char*>, 10> olderNames{{
    CORTEX_CALL(poll),
    CORTEX_CALL(select),
    CORTEX_CALL(open),
    CORTEX_CALL(stat),
    CORTEX_CALL(access),
    CORTEX_CALL(fork),
    CORTEX_CALL(vfork),
    CORTEX_CALL(pipe),
    CORTEX_CALL(epoll_wait),
    CORTEX_CALL(unlink),
}};
#else
constexpr std::array<std::pair<long, const char*>, 0> olderNames{};
#endif
#undef CORTEX_CALL

}  // namespace

void trapSystemCallsOfThisThread() {
    installHandler();
    constexpr std::array allowed{SYS_clock_gettime, SYS_rt_sigreturn, SYS_exit, SYS_exit_group};
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
        throw Error(std::string{"system calls cannot be watched: seccomp: "} +
                    std::strerror(errno));
    }
}

std::string nameOfSystemCall(long number) {
    for (const auto& [each, name] : names) {
        if (each == number) return name;
    }
    for (const auto& [each, name] : olderNames) {
        if (each == number) return name;
    }
    return "number " + std::to_string(number);
}

}  // namespace cortex::cs
