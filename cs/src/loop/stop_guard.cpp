// SPDX-License-Identifier: Apache-2.0
#include "loop/stop_guard.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/service_threads.hpp"

#include "tasks/crash_report.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <thread>
#include <utility>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#ifndef CORTEX_END_BUDGET_MS  // a sanitizer makes each end slower
#define CORTEX_END_BUDGET_MS 1'500
#endif

namespace cortex::cs {
namespace {

// After the signal all steps together; what is longer between two looks did not run.
constexpr std::int64_t budget = CORTEX_END_BUDGET_MS * 1'000'000LL;
constexpr std::int64_t mostBetweenLooks = 60'000'000;
constexpr int lookEvery = 20;  // ms
constexpr std::int64_t longStep = nsPerSecond;
constexpr int hungExitCode = 3;

// Streams of the C++ library may be locked by the thread that hangs. Where nobody reads, it says
// nothing: the end waits for no reader.
void say(const std::string& text) {
    pollfd ready{STDERR_FILENO, POLLOUT, 0};
    if (poll(&ready, 1, 0) == 0) return;
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

StopGuard& StopGuard::get() {
    static auto* const guard = new StopGuard;
    return *guard;
}

void StopGuard::begin(const sigset_t& signals) {
    if (begun_.exchange(true)) return;
    signals_ = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
    wake_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    std::atexit([] {
        [[maybe_unused]] static const auto* const last =  // to the end, so never destroyed
            new PhaseOfThread{"the end of the process after main()"};
        get().enter("the end of the process after main()", false);
    });
    const ServiceThreads named{"cortex-stop"};
    std::thread{[this] { run(); }}.detach();
}

void StopGuard::ask() {
    pending_.store(true);
    ending_.store(true);
    wake();
}

void StopGuard::goesOn() {
    if (!pending_.load()) ending_.store(false);
}

StopGuard::Steps::iterator StopGuard::enter(std::string what, bool isWait) {
    Steps step;
    step.push_back({std::move(what), isWait, monotonicNow()});
    const auto entered = step.begin();
    {
        const std::lock_guard lock{mutex_};
        steps_.splice(steps_.end(), step);
    }
    wake();
    return entered;
}

void StopGuard::leave(Steps::iterator step) {
    Steps left;
    const std::lock_guard lock{mutex_};
    left.splice(left.end(), steps_, step);
}

void StopGuard::wake() {
    if (wake_ >= 0) eventfd_write(wake_, 1);
}

void StopGuard::run() {
    last_ = monotonicNow();
    for (;;) {
        wait();
        look();
    }
}

void StopGuard::wait() {
    std::array<pollfd, 2> files{pollfd{signals_, POLLIN, 0}, pollfd{wake_, POLLIN, 0}};
    poll(files.data(), files.size(), isBusy_ ? lookEvery : -1);
    eventfd_t count = 0;
    eventfd_read(wake_, &count);
    signalfd_siginfo taken;
    while (::read(signals_, &taken, sizeof taken) > 0) ask();
}

void StopGuard::look() {
    const std::int64_t now = monotonicNow();
    const std::int64_t passed = std::min(now - std::exchange(last_, now), mostBetweenLooks);
    const bool ending = ending_.load();
    if (!ending) spent_ = 0;
    std::unique_lock lock{mutex_, std::try_to_lock};
    if (!lock.owns_lock() || (ending && !steps_.empty())) {
        isBusy_ = true;
        if (ending) spent_ += passed;
        if (spent_ > budget) {
            endProcess(lock.owns_lock() ? steps_.back().what : "a thread that hangs");
        }
        return;
    }
    isBusy_ = ending;
    for (Step& step : steps_) {
        if (step.isWait || step.told) continue;
        isBusy_ = true;
        const bool innermost = &step == &steps_.back();
        if (!innermost || now - step.began < longStep) continue;
        step.told = true;
        say("it takes longer than a second: " + step.what + "\n");
    }
}

void StopGuard::endProcess(const std::string& what) {
    say("the process was asked to end and does not: it hangs in " + what +
        "; ending it with exit code " + std::to_string(hungExitCode) + "\n");
    _exit(hungExitCode);
}

}  // namespace cortex::cs
