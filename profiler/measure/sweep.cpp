// SPDX-License-Identifier: Apache-2.0
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cortex::profiler {
namespace {

constexpr double enough = 1.02;  // the bisection ends when its ends are so close

double rounded(double x, double grain) { return std::max(grain, std::round(x / grain) * grain); }

bool known(const Sweep& sweep, double x) {
    return std::ranges::any_of(sweep.points, [x](const SweepPoint& point) { return point.x == x; });
}

// Adds points to a sweep as long as nobody stops it.
class Sweeper {
public:
    Sweeper(Sweep& sweep, const SweepPlan& plan, const SweepSubject& subject, Progress& progress,
            Results& results)
        : sweep_{sweep},
          grain_{plan.grain},
          subject_{subject},
          steps_{progress, expectedSteps(plan)},
          results_{results} {}

    bool add(double wanted) {
        const double x = rounded(wanted, grain_);
        if (known(sweep_, x)) return true;
        const std::string text = number(x) + " " + std::string{subject_.unit};
        if (!steps_.next(text)) return false;
        Measured measured = measure(x);
        // A disturbance of the machine is no overflow: another try where it is not clear.
        if (measured.complete && measured.overflows() && measured.duty(0.5) < 95) {
            if (!steps_.next(text + ", again")) return false;
            Measured again = measure(x);
            if (again.complete && again.duty(0.99) < measured.duty(0.99)) measured = again;
        }
        if (!measured.complete) return false;
        const auto place = std::ranges::lower_bound(sweep_.points, x, {}, &SweepPoint::x);
        sweep_.points.insert(place, {x, std::move(measured)});
        sweep_.judge();
        return true;
    }

private:
    Measured measure(double x) {
        const auto loop = subject_.make(x);
        noteRefusals(loop->refusals(), results_);
        Measured measured = loop->run(subject_.plan(x), [this] { return !steps_.keepsOn(); });
        sweep_.threads = std::max(sweep_.threads, loop->threads());
        return measured;
    }

    Sweep& sweep_;
    double grain_;
    const SweepSubject& subject_;
    Steps steps_;
    Results& results_;
};

double crossing(const Sweep& sweep, double duty,
                const std::function<double(const Measured&)>& dutyOf) {
    const auto& points = sweep.points;
    double found = 0;
    for (std::size_t i = 0; i < points.size() && points[i].x <= sweep.withoutOverflow; ++i) {
        const double here = dutyOf(points[i].measured);
        if (here > duty) continue;
        found = points[i].x;
        if (i + 1 == points.size()) continue;
        const double next = dutyOf(points[i + 1].measured);
        if (next > duty) found += (points[i + 1].x - found) * (duty - here) / (next - here);
    }
    return found;
}

bool raise(const SweepPlan& plan, Sweep& sweep, Sweeper& sweeper) {
    const auto far = [&] {
        return !sweep.points.empty() && sweep.points.back().measured.duty(0.5) > 100;
    };
    for (const double x : plan.first) {
        if (far()) break;
        if (!sweeper.add(x)) return false;
    }
    for (double x = plan.first.back() * 1.5; sweep.overflow == 0 && x <= plan.most; x *= 1.5) {
        if (!sweeper.add(x)) return false;
    }
    return true;
}

bool refine(const SweepPlan& plan, Sweep& sweep, Sweeper& sweeper) {
    for (int i = 0; i < plan.bisections && sweep.overflow > 0 && sweep.withoutOverflow > 0; ++i) {
        const double middle =
            rounded(std::sqrt(sweep.withoutOverflow * sweep.overflow), plan.grain);
        if (sweep.overflow / sweep.withoutOverflow < enough || known(sweep, middle)) break;
        if (!sweeper.add(middle)) return false;
    }
    const double found = sweep.withoutOverflow;
    for (const double times : plan.around) {
        if (found > 0 && found * times <= plan.most && !sweeper.add(found * times)) return false;
    }
    return true;
}

}  // namespace

void Sweep::judge() {
    withoutOverflow = overflow = 0;
    for (const SweepPoint& point : points) {
        if (!point.measured.overflows()) withoutOverflow = point.x;
    }
    for (const SweepPoint& point : points) {
        if (overflow == 0 && point.x > withoutOverflow) overflow = point.x;
    }
}

double Sweep::atDuty(double duty) const {
    return crossing(*this, duty, [](const Measured& measured) { return measured.duty(0.99); });
}

std::vector<double> Sweep::atDutyOfBlocks(double duty) const {
    std::size_t blocks = 0;
    for (const SweepPoint& point : points) {
        blocks = std::max(blocks, point.measured.blockP99.size());
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < blocks && blocks > 1; ++i) {
        found.push_back(crossing(
            *this, duty, [i](const Measured& measured) { return measured.dutyOfBlock(i); }));
    }
    return found;
}

bool Steps::next(std::string_view doing) {
    doing_ = doing;
    ++done_;
    return keepsOn();
}

bool Steps::keepsOn() {
    const double part = std::min(0.99, static_cast<double>(done_ - 1) / expected_);
    stopped_ = !progress_.step(std::max(part, 0.0), doing_);
    return !stopped_;
}

int expectedSteps(const SweepPlan& plan) {
    // Where a loop overflows it is measured again: at what lies above, and half of the bisections.
    const auto above = std::ranges::count_if(plan.around, [](double part) { return part > 1; });
    return static_cast<int>(plan.first.size() + plan.around.size()) + static_cast<int>(above) +
           plan.bisections * 3 / 2 + 2;
}

Sweep sweepUpwards(const SweepPlan& plan, const SweepSubject& subject, Progress& progress,
                   Results& results) {
    Sweep sweep;
    Sweeper sweeper{sweep, plan, subject, progress, results};
    sweep.complete = raise(plan, sweep, sweeper) && refine(plan, sweep, sweeper);
    return sweep;
}

Series lineOf(const Sweep& sweep, std::string name,
              const std::function<double(const Measured&)>& value,
              const std::function<bool(const SweepPoint&)>& holds, bool baseline) {
    Series line{std::move(name), {}, baseline};
    for (const SweepPoint& point : sweep.points) {
        if (!holds || holds(point)) line.points.push_back({point.x, value(point.measured)});
    }
    return line;
}

void markOverflow(const Sweep& sweep, Figure& figure) {
    if (sweep.overflow == 0 || sweep.withoutOverflow == 0) return;
    figure.marks.push_back({Mark::Along::X, sweep.withoutOverflow,
                            "the last without overflow: " + number(sweep.withoutOverflow)});
}

void noteRefusals(const std::vector<std::string>& refusals, Results& results) {
    for (const std::string& each : refusals) {
        if (std::ranges::find(results.notes, each) == results.notes.end()) {
            results.notes.push_back(each);
        }
    }
}

std::string conditions(const RunOptions& options, std::uint32_t threads, double frequency) {
    return std::to_string(threads) + (threads == 1 ? " thread" : " threads") + " of the loop, " +
           (options.priority == 0
                ? "no real-time priority"
                : "SCHED_FIFO " + std::to_string(options.priority) + ", CPUs kept awake") +
           (frequency > 0 ? ", " + number(frequency) + " Hz" : "");
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", value < 10 && value != std::floor(value) ? 2 : 0,
                  value);
    return text;
}

}  // namespace cortex::profiler
