// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include <signal.h>
#include <termios.h>

namespace cortex::cli {

enum class Woken { ByTime, ByKey, BySize, BySignal };

// Signals that end or resize come as answers to wait() as long as this lives. To be made before
// any thread, which would otherwise get them.
class Signals {
public:
    Signals();
    ~Signals();
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    // Until a signal, a key (only if `keys`) or `limit`.
    Woken wait(std::chrono::milliseconds limit, bool keys);
    char key() const { return key_; }  // the last

private:
    Woken read();

    int file_ = -1;
    char key_ = 0;
    sigset_t before_{};
};

// A terminal's other screen, without cursor and echo; what was there returns at the end.
class Screen {
public:
    Screen() { enter(); }
    ~Screen() { leave(); }
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    static bool possible();  // output is a terminal that can place text
    bool hasKeys() const { return before_.has_value(); }
    static std::size_t columns();
    static std::size_t rows();
    static void show(const std::string& lines);  // in place of what is there

private:
    void enter();
    void leave();

    std::optional<termios> before_;
};

}  // namespace cortex::cli
