// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// Counts the samples that could not be encoded, and tells so once of each type. Any thread.
class UnsentSamples {
public:
    void add(const char* type) {
        count_.fetch_add(1, std::memory_order_relaxed);
        const std::lock_guard lock{mutex_};
        if (!told_.insert(type).second) return;
        reports_.push_back(std::string{"a sample of "} + type +
                           " cannot be sent: one of its texts has more than 65536 octets");
    }
    std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
    std::vector<std::string> takeReports() {
        const std::lock_guard lock{mutex_};
        return std::exchange(reports_, {});
    }

private:
    std::atomic<std::uint64_t> count_{0};
    std::mutex mutex_;
    std::set<std::string> told_;
    std::vector<std::string> reports_;
};

}  // namespace cortex::comms
