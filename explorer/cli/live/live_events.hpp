// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace cortex::cli {

// Events on their way from the mirror's thread to ours.
class Arrivals {
public:
    void push(const comms::AgentEvent& event) {
        {
            const std::lock_guard lock{mutex_};
            events_.push_back(event);
        }
        changed_.notify_one();
    }
    // All that have come; waits for one. Empty: none within `limit`.
    std::vector<comms::AgentEvent> take(std::chrono::milliseconds limit) {
        std::unique_lock lock{mutex_};
        changed_.wait_for(lock, limit, [&] { return !events_.empty(); });
        return std::exchange(events_, {});
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<comms::AgentEvent> events_;
};

}  // namespace cortex::cli
