// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/patience.hpp"

#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <source_location>
#include <stdexcept>
#include <string>
#include <thread>

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

// Looks until the condition holds, while patience lasts and it can still come. Empty: it holds;
// otherwise why it does not.
template <class Condition, class Pause>
std::string whyNot(Condition condition, Pause pause) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        if (std::string why = hopeless ? hopeless() : ""; !why.empty()) return why;
        if (std::chrono::steady_clock::now() > end)
            return "did not come in " + std::to_string(patience.count()) + " s";
        pause();
    }
    return {};
}

// The same, where the place that waits fails with what it saw last.
template <class Condition, class Pause>
bool looksUntil(Condition condition, Pause pause, const Place& place) {
    const std::string why = whyNot(condition, pause);
    if (why.empty()) return true;
    ADD_FAILURE_AT(place.file_name(), static_cast<int>(place.line()))
        << place.function_name() << " waits in vain: " << why
        << (seenLast ? "\nSeen last: " + seenLast() : "");
    return false;
}

// The same for what has a name. A failure says what `last` saw at the end. A condition that can no
// longer come true throws why, and fails at once.
inline testing::AssertionResult comesTrue(const std::string& what,
                                          const std::function<bool()>& condition,
                                          const std::function<std::string()>& last = {}) {
    std::string why;
    try {
        why = whyNot(condition, [] { std::this_thread::sleep_for(std::chrono::milliseconds{1}); });
    } catch (const std::exception& error) {
        why = std::string{"can no longer come: "} + error.what();
    }
    if (why.empty()) return testing::AssertionSuccess();
    auto failure = testing::AssertionFailure() << what << " " << why;
    if (last) failure << "; seen last: " << last();
    return failure;
}

// The same for a helper outside of a test's body: it throws what the failure says.
inline void waitUntil(const std::string& what, const std::function<bool()>& condition,
                      const std::function<std::string()>& last = {}) {
    const auto came = comesTrue(what, condition, last);
    if (!came) throw std::runtime_error(came.message());
}

// The status of a child, once it has ended. None: it did not in longestRun, and was killed.
inline std::optional<int> statusOf(pid_t child) {
    const auto end = std::chrono::steady_clock::now() + longestRun;
    int status = 0;
    while (child > 0 && std::chrono::steady_clock::now() < end) {
        if (waitpid(child, &status, WNOHANG) != 0) return status;
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    if (child > 0 && kill(child, SIGKILL) == 0) waitpid(child, nullptr, 0);
    return std::nullopt;
}

}  // namespace cortex::test
