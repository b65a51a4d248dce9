// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "measure/measured_loop.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cortex::profiler {

struct SweepPoint {
    double x = 0;
    Measured measured;
};

// One quantity raised until the loop overflows.
struct Sweep {
    std::vector<SweepPoint> points;  // by x
    double withoutOverflow = 0;      // greatest x
    double overflow = 0;             // least x above it that did; 0: not reached
    std::uint32_t threads = 1;
    bool complete = false;

    // Greatest x at which p99 of the duty cycle is at most `duty` %, interpolated; 0: none.
    double atDuty(double duty) const;
    std::vector<double> atDutyOfBlocks(double duty) const;  // the same by each block alone
    void judge();                                           // after a point was added
};

struct SweepPlan {
    std::vector<double> first;  // ascending; further ones follow until there is an overflow
    double most = 0;            // not beyond
    int bisections = 5;
    double grain = 1;            // x are multiples of it
    std::vector<double> around;  // multiples of the overflow point, in the end
};

// Counts what is done of a measurement whose number of steps is about known.
class Steps {
public:
    Steps(Progress& progress, int expected) : progress_{progress}, expected_{expected} {}
    bool next(std::string_view doing);
    bool keepsOn();
    bool stopped() const { return stopped_; }

private:
    Progress& progress_;
    int expected_, done_ = 0;
    std::string doing_;
    bool stopped_ = false;
};

int expectedSteps(const SweepPlan& plan);

// How each point of a sweep is measured.
struct SweepSubject {
    std::string_view unit;  // of x, for the progress: "simplexes"
    std::function<std::unique_ptr<MeasuredLoop>(double x)> make;
    std::function<RecordingPlan(double x)> plan;
};
// What there is when the progress is stopped is kept; refusals go to the notes.
Sweep sweepUpwards(const SweepPlan& plan, const SweepSubject& subject, Progress& progress,
                   Results& results);

// A line of all points for which `holds`.
Series lineOf(const Sweep& sweep, std::string name,
              const std::function<double(const Measured&)>& value,
              const std::function<bool(const SweepPoint&)>& holds = {}, bool baseline = false);
// Vertical, where it was found.
void markOverflow(const Sweep& sweep, Figure& figure);
void noteRefusals(const std::vector<std::string>& refusals, Results& results);
// "2 threads, no real-time priority, 1000 Hz"
std::string conditions(const RunOptions& options, std::uint32_t threads, double frequency);
std::string number(double value);

}  // namespace cortex::profiler
