// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>

#include <signal.h>

namespace cortex::cs {

// Takes the signals that ask for the end, and ends the process where it does not end by itself.
// It looks only at the steps that a program says it is in, so that nothing of a user's is cut off.
// One of a process, never destroyed: it also sees what the C library does after main().
class StopGuard {
public:
    struct Step {
        std::string what;
        bool isWait;             // it may last, unless the end was asked for
        std::int64_t began = 0;  // ns of the monotonic clock
        bool told = false;
    };
    using Steps = std::list<Step>;

    static StopGuard& get();
    void begin(const sigset_t& signals);  // the first call starts its thread
    void ask();                           // as a signal does
    bool takeSignal() { return pending_.exchange(false); }
    void goesOn();  // the program waits anew, so it does not end

    Steps::iterator enter(std::string what, bool isWait);
    void leave(Steps::iterator step);

private:
    void run();
    void wait();
    void look();
    void wake();
    [[noreturn]] void endProcess(const std::string& what);

    std::mutex mutex_;  // whoever holds it may be held: the guard only tries
    Steps steps_;
    std::atomic<bool> pending_{false};  // a signal that nobody has taken
    std::atomic<bool> ending_{false};
    std::atomic<bool> begun_{false};
    int signals_ = -1, wake_ = -1;

    // Its thread only.
    bool isBusy_ = false;
    std::int64_t last_ = 0, spent_ = 0;
};

}  // namespace cortex::cs
