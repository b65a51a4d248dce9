// SPDX-License-Identifier: Apache-2.0
#include "terminal_progress.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

namespace cortex::profiler {
namespace {

std::atomic<int> stops{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void noteStop(int) {
    if (stops.fetch_add(1) > 0) std::_Exit(1);
}

}  // namespace

void noteStopSignals() {
    struct sigaction action{};
    action.sa_handler = noteStop;
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool stopAsked() { return stops.load() > 0; }

void TerminalProgress::begin(std::string_view name, double seconds) {
    before_ += own_;
    own_ = seconds;
    name_ = name;
    doing_.clear();
}

bool TerminalProgress::step(double part, std::string_view doing) {
    if (doing != doing_) {
        const double done = std::clamp((before_ + own_ * part) / std::max(total_, 0.1), 0.0, 1.0);
        doing_ = doing;
        std::fprintf(stderr, "[%2.0f %%] %s: %s\n", 100 * done, name_.c_str(), doing_.c_str());
    }
    return !stopAsked();
}

std::size_t terminalWidth(int file) {
    winsize size{};
    if (ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 100;
    return size.ws_col;
}

std::string durationText(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (whole < 60) return std::to_string(whole) + " s";
    const std::string rest = whole % 60 == 0 ? "" : " " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 60) + " min" + rest;
}

}  // namespace cortex::profiler
