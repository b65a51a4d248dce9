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

TerminalProgress::TerminalProgress(double seconds)
    : total_{std::max(seconds, 0.1)}, terminal_{isatty(STDERR_FILENO) != 0} {}

void TerminalProgress::begin(std::string_view name, double seconds) {
    before_ += own_;
    own_ = seconds;
    name_ = name;
    doing_.clear();
}

bool TerminalProgress::step(double part, std::string_view doing) {
    const auto now = Clock::now();
    const bool isNew = doing != doing_;
    const std::chrono::milliseconds pause{terminal_ ? 200 : 30'000};
    if (!isNew && now - written_ < pause) return !stopAsked();
    doing_ = doing;
    written_ = now;
    const double done = std::clamp((before_ + own_ * part) / total_, 0.0, 1.0);
    std::string line =
        "[" + std::to_string(static_cast<int>(100 * done)) + " %] " + name_ + ": " + doing_;
    if (stopAsked()) line += " (stopping; once more to end at once)";
    if (!terminal_) {
        std::fprintf(stderr, "%s\n", line.c_str());
    } else {
        line.resize(std::min(line.size(), terminalWidth(STDERR_FILENO) - 1));
        std::fprintf(stderr, "\r\033[K%s", line.c_str());
        shown_ = true;
    }
    std::fflush(stderr);
    return !stopAsked();
}

void TerminalProgress::clear() {
    if (shown_) std::fputs("\r\033[K", stderr);
    shown_ = false;
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
