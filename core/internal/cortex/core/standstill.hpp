// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace cortex {

// Why a loop stands still: "hangs in /ctl.stateActive".
struct Standstill {
    std::string why;
    std::int64_t since = 0;  // ns of the monotonic clock
};

// What the watchdog of a loop found, for those who tell others. Any thread but the loop's.
class StandstillNote {
public:
    void set(Standstill standstill) {
        const std::lock_guard lock{mutex_};
        present_ = std::move(standstill);
    }
    void clear() {
        const std::lock_guard lock{mutex_};
        present_.reset();
    }
    std::optional<Standstill> get() const {
        const std::lock_guard lock{mutex_};
        return present_;
    }

private:
    mutable std::mutex mutex_;
    std::optional<Standstill> present_;
};

}  // namespace cortex
