// SPDX-License-Identifier: Apache-2.0
#include "repeating.hpp"

#include "cortex/core/service_threads.hpp"

#include <utility>

namespace cortex::toolkit {

void Repeating::start(const char* threadName, Pause first, std::function<Pause()> step) {
    const ServiceThreads named{threadName};
    thread_ = std::thread{[this, first, step = std::move(step)] { run(first, step); }};
}

bool Repeating::finish() {
    if (!thread_.joinable()) return false;
    {
        const std::lock_guard lock{mutex_};
        ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
    return true;
}

void Repeating::run(Pause pause, const std::function<Pause()>& step) {
    std::unique_lock lock{mutex_};
    while (!wake_.wait_for(lock, pause, [this] { return ending_; })) {
        lock.unlock();
        pause = step();
        lock.lock();
    }
}

}  // namespace cortex::toolkit
