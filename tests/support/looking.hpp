// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/patience.hpp"

#include <chrono>
#include <functional>
#include <source_location>
#include <string>

#include <sys/wait.h>

#include <gtest/gtest.h>

namespace cortex::test {

using Place = std::source_location;

// What a wait asks the helpers of a test for: why nothing can come any more, empty while it can;
// and what was seen last.
inline std::function<std::string()> hopeless, seenLast;

// How a child of this process ended, which is still to be waited for; empty: it runs.
inline std::string howItEnded(pid_t child) {
    siginfo_t how{};
    waitid(P_PID, static_cast<id_t>(child), &how, WEXITED | WNOHANG | WNOWAIT);
    if (how.si_pid == 0) return {};
    return (how.si_code == CLD_EXITED ? "ended with code " : "was ended by signal ") +
           std::to_string(how.si_status);
}

// Looks until the condition holds, while patience lasts and it can still come. Otherwise the place
// that waits fails with what it saw last.
template <class Condition, class Pause>
bool looksUntil(Condition condition, Pause pause, const Place& place) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        std::string why = hopeless ? hopeless() : std::string{};
        if (why.empty() && std::chrono::steady_clock::now() > end) {
            why = "it did not come in " + std::to_string(patience.count()) + " s";
        }
        if (!why.empty()) {
            ADD_FAILURE_AT(place.file_name(), static_cast<int>(place.line()))
                << place.function_name() << " waits in vain: " << why
                << (seenLast ? "\nSeen last: " + seenLast() : "");
            return false;
        }
        pause();
    }
    return true;
}

}  // namespace cortex::test
