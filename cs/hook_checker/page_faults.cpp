// SPDX-License-Identifier: Apache-2.0
#include "hook_checker/page_faults.hpp"

#include "hook_checker/offence.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include <link.h>
#include <linux/perf_event.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

namespace cortex::cs {

namespace {

constexpr int perfTrap = 6;  // TRAP_PERF of Linux 5.13, which glibc 2.36 does not name

struct sigaction before;

// An address that the kernel tells as a number.
void* pointerTo(std::uintptr_t address) {
    return reinterpret_cast<void*>(address);  // NOLINT(performance-no-int-to-ptr)
}

void onFault(int signal, siginfo_t* info, void* place) {
    if (info->si_code != perfTrap) {  // a debugger's: as it was
        sigaction(signal, &before, nullptr);
        raise(signal);
        return;
    }
    const auto& machine = static_cast<ucontext_t*>(place)->uc_mcontext;
#if defined(__x86_64__)
    const auto at = static_cast<std::uintptr_t>(machine.gregs[REG_RIP]);
#elif defined(__aarch64__)
    const auto at = static_cast<std::uintptr_t>(machine.pc);
#endif
    note(Offence::PageFault, 0, nullptr, pointerTo(at));
}

// The end of the variables without a value that begin at this address; 0: there are none. Memory
// that somebody asked for may lie right behind them, and is none of them.
std::uintptr_t endOfVariables(std::uintptr_t first) {
    struct Search {
        std::uintptr_t first, end;
    } search{first, 0};
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* data) {
            constexpr std::uintptr_t page = 4096;
            auto& wanted = *static_cast<Search*>(data);
            for (std::size_t i = 0; i < info->dlpi_phnum; ++i) {
                const ElfW(Phdr)& segment = info->dlpi_phdr[i];
                if (segment.p_type != PT_LOAD) continue;
                const std::uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
                const std::uintptr_t end = (begin + segment.p_memsz + page - 1) / page * page;
                if (begin <= wanted.first && wanted.first < end) wanted.end = end;
            }
            return wanted.end != 0 ? 1 : 0;
        },
        &search);
    return search.end;
}

// Code, constants and variables of all that is loaded, and the heap: a page of a file that is read
// for the first time is no fault of a hook. Memory that was only asked for is left alone.
void bringIn() {
    std::ifstream maps{"/proc/self/maps"};
    std::uintptr_t endOfFile = 0;  // what begins there, of no file, are variables without a value
    for (std::string line; std::getline(maps, line);) {
        std::istringstream fields{line};
        std::uintptr_t first = 0, end = 0;
        char dash = 0;
        std::string rights, offset, device, node, name;
        fields >> std::hex >> first >> dash >> end >> rights >> offset >> device >> node >> name;
        const bool ofFile = name.starts_with("/");
        const std::uintptr_t last = name.empty() && first == endOfFile ? endOfVariables(first) : 0;
        const bool ofProgram = ofFile || name == "[heap]" || last != 0;
        if (ofFile) endOfFile = end;
        if (last != 0) end = std::min(end, last);
        if (!ofProgram || rights[0] != 'r' || rights[3] != 'p' || name.starts_with("/dev/"))
            continue;
        // Locked, where that is allowed: the system takes no page away while it is checked.
        if (mlock(pointerTo(first), end - first) == 0) continue;
        madvise(pointerTo(first), end - first,
                rights[1] == 'w' ? MADV_POPULATE_WRITE : MADV_POPULATE_READ);
    }
}

}  // namespace

std::string trapPageFaultsOfThisThread() {
    bringIn();
    struct sigaction action{};
    action.sa_sigaction = onFault;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    struct sigaction present{};
    sigaction(SIGTRAP, nullptr, &present);
    if (present.sa_sigaction != onFault) sigaction(SIGTRAP, &action, &before);

    sigset_t trapped;
    sigemptyset(&trapped);
    sigaddset(&trapped, SIGTRAP);
    pthread_sigmask(SIG_UNBLOCK, &trapped, nullptr);
    perf_event_attr event{};
    event.size = sizeof event;
    event.type = PERF_TYPE_SOFTWARE;
    event.config = PERF_COUNT_SW_PAGE_FAULTS;
    event.sample_period = 1;
    event.exclude_kernel = 1;
    event.exclude_hv = 1;
    event.sigtrap = 1;
    event.remove_on_exec = 1;
    // It stays open: the thread ends with the process, or shortly before.
    if (syscall(SYS_perf_event_open, &event, 0, -1, -1, PERF_FLAG_FD_CLOEXEC) >= 0) return {};
    return errno == EACCES || errno == EPERM
               ? "this user may not: set kernel.perf_event_paranoid to 2 with sysctl, or run as "
                 "root"
               : std::string{"perf_event_open: "} + std::strerror(errno) + "; it needs Linux 5.13";
}

}  // namespace cortex::cs
