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

using Condition = std::function<bool(const Measured&)>;

// One quantity raised until the loop overflows.
struct Sweep {
    std::vector<SweepPoint> points;  // by x
    std::uint32_t threads = 1;
    bool complete = false;

    // The greatest x that was measured such that it and all below it hold; 0: none. And the least
    // above, which does not; 0: all hold.
    double greatest(const Condition& condition) const;
    double above(const Condition& condition) const;
    double withoutOverflow() const;
    double overflow() const;
    // greatest() with p99 of the duty cycle within that, by each block alone: its noise.
    std::vector<double> dutyWithinByBlocks(double percent) const;
};
Condition dutyWithin(double percent);  // p99, without overflow
// The greatest x within 70 % of duty cycle, at least `wanted`.
Quantity capacityOf(const Sweep& sweep, double wanted);

struct SweepPlan {
    std::vector<double> first;  // ascending; further ones follow until there is an overflow
    double most = 0;            // not beyond
    int bisections = 5;
    double grain = 1;            // x are multiples of it
    double duty = 0;             // in %: where p99 reaches it is looked for, too
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
inline constexpr const char* overflowText =
    "Overflow: p99 of the cycle is longer than the period, or more ticks are missed than by the "
    "sleeper and 1 in 100. The last without overflow is the largest number at which it and all "
    "smaller ones passed, each measured once.";
// Vertical, where it was found.
void markOverflow(const Sweep& sweep, Figure& figure);
void noteRefusals(const std::vector<std::string>& refusals, Results& results);
// "2 threads, no real-time priority, 1000 Hz"
std::string conditions(const RunOptions& options, std::uint32_t threads, double frequency);

}  // namespace cortex::profiler
