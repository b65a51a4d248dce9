// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_listening.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace cortex::comms {

class MirrorListener {
public:
    virtual ~MirrorListener() = default;
    virtual void stop() = 0;
};

// A function that the mirror's thread calls until somebody stops it. The mutex is recursive,
// because the function itself may do that.
template <class... Told>
class ListenerOf : public MirrorListener {
public:
    using Function = std::function<void(Told...)>;

    explicit ListenerOf(Function function) : function_{std::move(function)} {}

    void tell(Told... told) {
        const std::lock_guard lock{mutex_};
        if (stopped_) return;
        running_ = true;
        function_(told...);
        running_ = false;
        if (stopped_) function_ = nullptr;
    }
    void stop() override {
        const std::lock_guard lock{mutex_};
        stopped_ = true;
        if (!running_) function_ = nullptr;
    }
    bool stopped() const { return stopped_; }

private:
    std::recursive_mutex mutex_;
    Function function_;
    bool running_ = false;
    std::atomic<bool> stopped_{false};
};

// Under the mutex of the mirror; those that list() gives are told outside of it.
template <class... Told>
class Listeners {
public:
    using Listener = ListenerOf<Told...>;

    Listening add(typename Listener::Function function) {
        auto listener = std::make_shared<Listener>(std::move(function));
        listeners_.push_back(listener);
        return Listening{listener};
    }
    // Those that nobody has stopped.
    const std::vector<std::shared_ptr<Listener>>& list() {
        std::erase_if(listeners_, [](const auto& each) { return each->stopped(); });
        return listeners_;
    }

private:
    std::vector<std::shared_ptr<Listener>> listeners_;
};

}  // namespace cortex::comms
