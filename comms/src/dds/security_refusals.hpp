// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// Collects what security has refused on threads of DDS. Each text is kept once in ten seconds,
// however often it occurs. It is bounded. Any thread.
class Refusals {
public:
    void add(std::string text) {
        const auto now = Clock::now();
        const std::lock_guard lock{mutex_};
        std::erase_if(said_, [&](const auto& each) { return now - each.second > interval; });
        if (said_.size() >= most || !said_.emplace(text, now).second) return;
        if (texts_.size() < most) texts_.push_back(std::move(text));
    }
    std::vector<std::string> take() {
        const std::lock_guard lock{mutex_};
        return std::exchange(texts_, {});
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t most = 64;
    static constexpr std::chrono::seconds interval{10};

    std::mutex mutex_;
    std::map<std::string, Clock::time_point> said_;
    std::vector<std::string> texts_;
};

}  // namespace cortex::comms
