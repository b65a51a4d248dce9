// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace cortex::toolkit {

// Does a step again and again on a thread of its own. All else: one thread.
class Repeating {
public:
    using Pause = std::chrono::milliseconds;

    Repeating() = default;
    ~Repeating() { finish(); }
    Repeating(const Repeating&) = delete;
    Repeating& operator=(const Repeating&) = delete;

    // Each step returns how long the pause after it is.
    void start(const char* threadName, Pause first, std::function<Pause()> step);
    bool finish();  // after the step that is at work; false: none was started, or it is over

private:
    void run(Pause pause, const std::function<Pause()>& step);

    std::mutex mutex_;
    std::condition_variable wake_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace cortex::toolkit
