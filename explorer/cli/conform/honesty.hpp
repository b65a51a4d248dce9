// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/plant.hpp"
#include "conform/sample.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace cortex::cli::conform {

inline constexpr std::int64_t linkIsOpen = 2;  // label of `link`

// What must hold of a device in each cycle that is seen, as long as it is looked at: the age and
// the stamps of what it measures, and its counters. Each text is the first that was wrong; "":
// nothing.
class Honesty {
public:
    explicit Honesty(const Plant& plant);

    void take(const Sample& sample);

    const std::string& age() const { return age_; }
    const std::string& stamps() const { return stamps_; }
    const std::string& counters() const { return counters_; }
    std::uint64_t cycles() const { return cycles_; }

    static constexpr std::array counterNames{"exchangeCount", "lateCount", "errorCount",
                                             "reconnectCount"};

private:
    struct Look {
        std::int64_t cycle = 0, time = 0;
        double age = 0;
        bool isOpen = false;
        std::array<double, counterNames.size()> counters{};
        std::vector<std::int64_t> stamps;  // of the observations, ns

        double answered() const { return counters[0]; }
        double reconnected() const { return counters[3]; }
    };

    Look look(const Sample& sample) const;
    void checkStamps(const Look& before, const Look& now);
    void checkCounters(const Look& before, const Look& now);
    // What shows a new answer may come a cycle before or after its count: so of the last cycle but
    // one, between the one before it and the newest.
    void checkAge();
    // Also an answer that was counted needs an open link. One that was opened and closed between
    // two cycles shows in reconnectCount.
    void checkClosed();

    const Plant& plant_;
    bool isFieldbus_;
    std::deque<Look> last_;  // at most four
    std::uint64_t cycles_ = 0;
    std::string age_, stamps_, counters_;
};

}  // namespace cortex::cli::conform
