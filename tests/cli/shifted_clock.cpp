// SPDX-License-Identifier: Apache-2.0
// Preloaded into a process: its time of day is SECONDS_AHEAD off.
#include <cstdlib>
#include <ctime>

#include <sys/syscall.h>
#include <unistd.h>

extern "C" __attribute__((visibility("default"))) int clock_gettime(clockid_t clock,
                                                                    timespec* time) noexcept {
    static const char* const ahead = std::getenv("SECONDS_AHEAD");
    const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
    if (result == 0 && clock == CLOCK_REALTIME && ahead != nullptr)
        time->tv_sec += std::atol(ahead);
    return result;
}
