// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/slow_work.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <string_view>

namespace cortex::cs {

// One SlowWork, as the thread sees it that does it. The hook writes `state` while it rests, the
// thread from Asked on; so what they share belongs to one of them at a time.
struct SlowWork::Job {
    enum class State : std::uint8_t { Rests, Asked, Runs };

    std::function<void()> work;
    bool isOfDevice = false;  // its thread does it, in place of the one of the process
    std::atomic<State> state{State::Rests};
    std::array<char, 200> failure{};
    std::size_t failureLength = 0;

    bool isAsked() const { return state.load(std::memory_order_acquire) == State::Asked; }
    void run() {
        state.store(State::Runs, std::memory_order_relaxed);
        failureLength = 0;
        try {
            work();
        } catch (const std::exception& error) {
            failed(error.what());
        } catch (...) {
            failed("it threw something that is no std::exception");
        }
        state.store(State::Rests, std::memory_order_release);
    }
    // In place of run().
    void refuse(std::string_view why) {
        failed(why);
        state.store(State::Rests, std::memory_order_release);
    }

private:
    void failed(std::string_view why) {
        failureLength = std::min(why.size(), failure.size());
        std::memcpy(failure.data(), why.data(), failureLength);
    }
};

}  // namespace cortex::cs
