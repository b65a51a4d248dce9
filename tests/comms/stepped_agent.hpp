// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comms/network_agent.hpp"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace cortex::comms {

// An agent on the network of this process whose loop runs about a thousand times a second.
class SteppedAgent : public NetworkAgent {
public:
    using NetworkAgent::NetworkAgent;
    ~SteppedAgent() { stop(); }

    void run() {
        rig.start();
        thread_ = std::thread{[this] {
            std::unique_lock lock{mutex_};
            while (!stopping_.wait_for(lock, std::chrono::milliseconds{1}, [&] { return stop_; })) {
                rig.step();
            }
        }};
    }
    // Between two cycles.
    template <class Function>
    void change(Function function) {
        const std::lock_guard lock{mutex_};
        function();
    }
    void stop() {
        if (!thread_.joinable()) return;
        change([this] { stop_ = true; });
        stopping_.notify_all();
        thread_.join();
    }

private:
    std::mutex mutex_;
    std::condition_variable stopping_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace cortex::comms
