// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measurement.hpp"

#include <cstddef>
#include <string>

namespace cortex::profiler {

// The first SIGINT or SIGTERM is noted, the second ends the process at once with exit code 1.
void noteStopSignals();
bool stopAsked();

// A line on standard error whenever something else is done. Several measurements one after the
// other, each with its share of the time.
class TerminalProgress final : public Progress {
public:
    explicit TerminalProgress(double seconds) : total_{seconds} {}

    void begin(std::string_view name, double seconds);  // of the next measurement
    bool step(double part, std::string_view doing) override;

private:
    double total_, before_ = 0, own_ = 0;
    std::string name_, doing_;
};

std::size_t terminalWidth(int file);       // 100 where it is no terminal
std::string durationText(double seconds);  // "2 min 5 s"

}  // namespace cortex::profiler
