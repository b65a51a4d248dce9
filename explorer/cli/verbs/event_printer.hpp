// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/past_events.hpp"
#include "live/kept_past.hpp"
#include "verbs/live_verbs.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cortex::cli {

// Events as `cortex events` prints them.
class EventPrinter {
public:
    explicit EventPrinter(const EventOptions& options);  // throws Failure for a wrong one

    // Whether its severity and kind are asked for, and it concerns what is at or below this prefix.
    bool shows(const comms::AgentEvent& event, const std::string& prefix) const;
    const std::vector<std::string>& kinds() const { return kinds_; }  // empty: all

    void head() const;
    // In text, `when` stands behind its time, and `remark` at its end.
    void line(const comms::AgentEvent& event, const std::string& when = "",
              const std::string& remark = "") const;

private:
    const EventOptions& options_;
    Severity least_;
    std::vector<std::string> kinds_;
};

// cortex events --before-fault: the newest one that was not later, UTC ns
Exit showBeforeFault(Live& live, Arrivals& arrivals, const EventOptions& options,
                     const EventPrinter& printer, std::int64_t until);

}  // namespace cortex::cli
