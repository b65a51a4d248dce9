// SPDX-License-Identifier: Apache-2.0
#include "sweep.hpp"

#include "report/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace cortex::profiler {
namespace {

constexpr double enough = 1.02;  // the bisection ends when its ends are so close

double rounded(double x, double grain) { return std::max(grain, std::round(x / grain) * grain); }

bool known(const Sweep& sweep, double x) {
    return std::ranges::any_of(sweep.points, [x](const SweepPoint& point) { return point.x == x; });
}

bool passes(const Measured& measured) { return !measured.overflows(); }

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
        if (!steps_.next(readable(x) + " " + std::string{subject_.unit})) return false;
        Measured measured = measure(x);
        if (!measured.complete) return false;
        const auto place = std::ranges::lower_bound(sweep_.points, x, {}, &SweepPoint::x);
        sweep_.points.insert(place, {x, std::move(measured)});
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

bool raise(const SweepPlan& plan, Sweep& sweep, Sweeper& sweeper) {
    const auto far = [&] {
        return !sweep.points.empty() && sweep.points.back().measured.duty(0.5) > 100;
    };
    for (const double x : plan.first) {
        if (far()) break;
        if (!sweeper.add(x)) return false;
    }
    const auto overflown = [&] { return sweep.above(passes) > 0; };
    for (double x = plan.first.back() * 1.5; !overflown() && x <= plan.most; x *= 1.5) {
        if (!sweeper.add(x)) return false;
    }
    return true;
}

// Halves what is between the greatest x that holds, with all below, and the one above it.
bool refine(const SweepPlan& plan, Sweep& sweep, Sweeper& sweeper, const Condition& condition) {
    for (int i = 0; i < plan.bisections; ++i) {
        const double below = sweep.greatest(condition), above = sweep.above(condition);
        if (below == 0 || above == 0 || above / below < enough) break;
        const double middle = rounded(std::sqrt(below * above), plan.grain);
        if (known(sweep, middle)) break;
        if (!sweeper.add(middle)) return false;
    }
    return true;
}

bool addAround(const SweepPlan& plan, Sweep& sweep, Sweeper& sweeper) {
    const double found = sweep.withoutOverflow();
    for (const double times : plan.around) {
        if (found > 0 && found * times <= plan.most && !sweeper.add(found * times)) return false;
    }
    return true;
}

}  // namespace

double Sweep::greatest(const Condition& condition) const {
    double found = 0;
    for (const SweepPoint& point : points) {
        if (!condition(point.measured)) break;
        found = point.x;
    }
    return found;
}

double Sweep::above(const Condition& condition) const {
    const auto found = std::ranges::find_if_not(points, condition, &SweepPoint::measured);
    return found == points.end() ? 0 : found->x;
}

double Sweep::withoutOverflow() const { return greatest(passes); }
double Sweep::overflow() const { return above(passes); }

Condition dutyWithin(double percent) {
    return [percent](const Measured& measured) {
        return passes(measured) && measured.duty(0.99) <= percent;
    };
}

Quantity capacityOf(const Sweep& sweep, double wanted) {
    constexpr double most = 70;
    const double above = sweep.above(dutyWithin(most));
    const auto point = std::ranges::find(sweep.points, above, &SweepPoint::x);
    const double median = point == sweep.points.end() ? most : point->measured.duty(0.5);
    Quantity capacity = judgedCapacity(sweep.greatest(dutyWithin(most)), median, most, wanted);
    capacity.repeats = sweep.dutyWithinByBlocks(most);
    return capacity;
}

std::vector<double> Sweep::dutyWithinByBlocks(double percent) const {
    std::size_t blocks = 0;
    for (const SweepPoint& point : points) {
        blocks = std::max(blocks, point.measured.blockP99.size());
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < blocks && blocks > 1; ++i) {
        found.push_back(greatest([i, percent](const Measured& measured) {
            return passes(measured) && measured.dutyOfBlock(i) <= percent;
        }));
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
    const int refinements = plan.duty > 0 ? 2 : 1;
    return static_cast<int>(plan.first.size() + plan.around.size()) +
           plan.bisections * refinements + 2;
}

Sweep sweepUpwards(const SweepPlan& plan, const SweepSubject& subject, Progress& progress,
                   Results& results) {
    Sweep sweep;
    Sweeper sweeper{sweep, plan, subject, progress, results};
    sweep.complete = raise(plan, sweep, sweeper) && refine(plan, sweep, sweeper, passes) &&
                     (plan.duty == 0 || refine(plan, sweep, sweeper, dutyWithin(plan.duty))) &&
                     addAround(plan, sweep, sweeper);
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
    const double found = sweep.withoutOverflow();
    if (sweep.overflow() == 0 || found == 0) return;
    figure.marks.push_back(
        {Mark::Along::X, found, "the last without overflow: " + readable(found)});
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
           (frequency > 0 ? ", " + readable(frequency) + " Hz" : "");
}

}  // namespace cortex::profiler
