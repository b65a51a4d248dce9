// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dds/participant.hpp"
#include "support/own_domain.hpp"
#include "support/waiting.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

namespace cortex::comms {

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

    // The first time that the condition holds; false where patience, or that time, is over.
    bool waitUntil(const std::function<bool(const std::vector<T>&)>& condition,
                   std::chrono::milliseconds within = test::patience) {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, within, [&] { return condition(elements_); });
    }
    bool waitFor(std::size_t count, const test::Place& place = test::Place::current()) {
        if (waitUntil([count](const auto& all) { return all.size() >= count; })) return true;
        ADD_FAILURE_AT(place.file_name(), static_cast<int>(place.line()))
            << elements().size() << " of " << count << " came; the others did not come in "
            << test::patience.count() << " s";
        return false;
    }
    std::vector<T> elements() const {
        const std::lock_guard lock{mutex_};
        return elements_;
    }
    std::vector<T> take() {
        const std::lock_guard lock{mutex_};
        return std::exchange(elements_, {});
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<T> elements_;
};

inline bool comesTrue(const std::function<bool()>& condition,
                      const test::Place& place = test::Place::current()) {
    return test::looksUntil(condition, std::this_thread::yield, place);
}

}  // namespace cortex::comms
