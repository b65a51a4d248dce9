// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/results.hpp"

#include <cstdint>
#include <string_view>

namespace cortex::profiler {

struct RunOptions {
    bool quick = false;
    std::uint32_t threads = 0;  // 0: as many as CPUs may be used, at most 4
    double frequency = 1000;    // Hz
    int priority = 0;           // SCHED_FIFO; 0: none
};

// What a measurement tells while it runs, and asks: whoever waits for it may have had enough.
class Progress {
public:
    virtual ~Progress() = default;
    // `part` of this measurement is done, 0 to 1. False: stop, what there is will be kept.
    virtual bool step(double part, std::string_view doing) = 0;
};

// One part of a measurement, from `from` to `to` of it.
class PartProgress final : public Progress {
public:
    PartProgress(Progress& whole, double from, double to) : whole_{whole}, from_{from}, to_{to} {}
    bool step(double part, std::string_view doing) override {
        return whole_.step(from_ + part * (to_ - from_), doing);
    }

private:
    Progress& whole_;
    double from_, to_;
};

// One of those that `cortex-profiler run` can be asked for. `run` adds figures and quantities as
// it gets them and returns early when told to stop.
struct Measurement {
    const char* name;
    const char* what;
    const char* heading;  // of its quantities
    double (*seconds)(const RunOptions& options);
    void (*run)(const RunOptions& options, Progress& progress, Results& results);
};

}  // namespace cortex::profiler
