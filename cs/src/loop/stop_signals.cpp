// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/cluster_cs.hpp"

#include <chrono>
#include <csignal>
#include <ctime>

namespace cortex::cs {

namespace {

sigset_t stopSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return signals;
}

}  // namespace

void blockStopSignals() {
    const sigset_t signals = stopSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

bool waitForInterrupt(double seconds, const std::function<bool()>& done) {
    blockStopSignals();
    const sigset_t signals = stopSignals();
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                         std::chrono::duration<double>{seconds});
    constexpr timespec poll{0, 50'000'000};
    for (;;) {
        const int signal = sigtimedwait(&signals, nullptr, &poll);
        if (signal > 0) return true;
        if (done && done()) return false;
        if (seconds > 0 && std::chrono::steady_clock::now() >= end) return false;
    }
}

}  // namespace cortex::cs
