// SPDX-License-Identifier: Apache-2.0
#include "text/interrupts.hpp"

#include <atomic>
#include <cstddef>

namespace cortex::cli {
namespace {

constexpr std::array ending{SIGINT, SIGTERM, SIGHUP};
std::atomic<int> came{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");

}  // namespace

// What was ignored before, as nohup does, stays so.
Interrupts::Interrupts() {
    struct sigaction action{};
    action.sa_handler = [](int signal) { came = signal; };
    for (std::size_t i = 0; i < ending.size(); ++i) {
        sigaction(ending[i], &action, &before_[i]);
        if (before_[i].sa_handler == SIG_IGN) sigaction(ending[i], &before_[i], nullptr);
    }
}

Interrupts::~Interrupts() {
    for (std::size_t i = 0; i < ending.size(); ++i) sigaction(ending[i], &before_[i], nullptr);
}

int Interrupts::signal() { return came; }

void Interrupts::forget() { came = 0; }

void throwIfInterrupted(const std::string& remark) {
    if (came != 0) throw Interrupted{remark};
}

}  // namespace cortex::cli
