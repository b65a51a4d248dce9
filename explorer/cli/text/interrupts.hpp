// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <string>

#include <signal.h>

namespace cortex::cli {

// Thrown where something was waited for; `remark` says what goes on without us, if anything.
struct Interrupted {
    std::string remark;
};

// While one of these lives, Ctrl-C and requests to end do not end the program: whatever waits
// throws Interrupted, and so everything is put back on the way out. Main thread.
class Interrupts {
public:
    Interrupts();
    ~Interrupts();
    Interrupts(const Interrupts&) = delete;
    Interrupts& operator=(const Interrupts&) = delete;

    static int signal();  // the last that came; 0: none
    static void forget();

private:
    std::array<struct sigaction, 3> before_{};
};

// The longest wait between two looks whether an interrupt came.
inline constexpr std::chrono::milliseconds interruptSlice{100};
void throwIfInterrupted(const std::string& remark = "");

}  // namespace cortex::cli
