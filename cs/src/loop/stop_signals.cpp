// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/cluster_cs.hpp"

#include "loop/stop_guard.hpp"
#include "tasks/crash_report.hpp"

#include <chrono>
#include <csignal>
#include <ctime>
#include <memory>
#include <utility>

#include <unistd.h>

namespace cortex::cs {

namespace {

bool isLeftToDefault(int signal) {
    struct sigaction action{};
    sigaction(signal, nullptr, &action);
    return action.sa_handler == SIG_DFL;
}

// A process that was started with `nohup` ignores that its terminal goes.
sigset_t stopSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
        if (each != SIGHUP || isLeftToDefault(each)) sigaddset(&signals, each);
    }
    return signals;
}

}  // namespace

// SIGPIPE comes to the thread that wrote, which nobody waits for. So it is passed on. A file that
// may not grow is an error of whoever writes it.
void blockStopSignals() {
    if (isLeftToDefault(SIGXFSZ)) std::signal(SIGXFSZ, SIG_IGN);
    const sigset_t signals = stopSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    StopGuard::get().begin(signals);
    if (!isLeftToDefault(SIGPIPE)) return;
    struct sigaction passOn{};
    passOn.sa_handler = [](int) { kill(getpid(), SIGTERM); };
    sigaction(SIGPIPE, &passOn, nullptr);
}

// A signal that came to this thread alone is not seen by the guard.
bool waitForInterrupt(double seconds, const std::function<bool()>& done) {
    blockStopSignals();
    StopGuard& guard = StopGuard::get();
    guard.goesOn();
    const BoundedStep waiting{"waitForInterrupt(), or what it calls", BoundedStep::Kind::Wait};
    const sigset_t signals = stopSignals();
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                         std::chrono::duration<double>{seconds});
    constexpr timespec poll{0, 50'000'000};
    for (;;) {
        if (sigtimedwait(&signals, nullptr, &poll) > 0) guard.ask();
        if (guard.takeSignal()) return true;
        if (done && done()) return false;
        if (seconds > 0 && std::chrono::steady_clock::now() >= end) return false;
    }
}

struct BoundedStep::Implementation {
    explicit Implementation(StopGuard::Steps::iterator entered)
        : step{entered}, phase{step->what.c_str()} {}

    StopGuard::Steps::iterator step;
    PhaseOfThread phase;
};

BoundedStep::BoundedStep(std::string what, Kind kind)
    : implementation_{std::make_unique<Implementation>(
          StopGuard::get().enter(std::move(what), kind == Kind::Wait))} {}

BoundedStep::~BoundedStep() {
    const auto step = implementation_->step;
    implementation_.reset();
    StopGuard::get().leave(step);
}

}  // namespace cortex::cs
