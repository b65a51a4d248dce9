// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "support/own_domain.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

namespace cortex::comms {

inline constexpr std::chrono::seconds longEnough{60};  // no test that passes waits so long

// A domain of this process alone, on the loopback interface.
inline NetworkOptions loopback() {
    NetworkOptions options;
    options.domain = test::ownDomain();
    options.interfaces = {"127.0.0.1"};
    return options;
}

// What a reader hands over, for a test that waits for it.
template <class T>
class Inbox {
public:
    auto push() {
        return [this](auto&& element) {
            const std::lock_guard lock{mutex_};
            elements_.push_back(std::forward<decltype(element)>(element));
            changed_.notify_all();
        };
    }

    // The first time that the condition holds; false after a long time, or that time.
    bool waitUntil(const std::function<bool(const std::vector<T>&)>& condition,
                   std::chrono::milliseconds within = longEnough) {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, within, [&] { return condition(elements_); });
    }
    bool waitFor(std::size_t count) {
        return waitUntil([count](const auto& elements) { return elements.size() >= count; });
    }
    std::vector<T> elements() const {
        const std::lock_guard lock{mutex_};
        return elements_;
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<T> elements_;
};

inline bool comesTrue(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + longEnough;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

}  // namespace cortex::comms
