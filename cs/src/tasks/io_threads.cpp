// SPDX-License-Identifier: Apache-2.0
#include "tasks/io_threads.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "tasks/beside_tick.hpp"
#include "tasks/crash_report.hpp"
#include "tasks/refused_exit.hpp"

namespace cortex::cs {

void IoThreads::begin(std::span<SimplexCS* const> simplexes) {
    for (SimplexCS* simplex : simplexes) {
        auto* threaded = dynamic_cast<ThreadedSimplex*>(simplex);
        if (threaded == nullptr) continue;
        threaded->beside_->begin(
            [threaded, phase = "communicate() of " + threaded->path()] {
                Escape escape;
                const PhaseOfThread present{phase.c_str(), &escape};
                if (_setjmp(escape.place) == 0)
                    threaded->runThread();
                else
                    throw Error(refusedExitText());
            },
            [threaded] {
                if (const EventText* death = threaded->beside_->death()) threaded->doWork(death);
            });
        simplexes_.push_back(threaded);
    }
}

std::string IoThreads::end() {
    constexpr std::int64_t budget = 3 * nsPerSecond / 2;
    for (ThreadedSimplex* simplex : simplexes_) simplex->beside_->askToEnd();
    const std::int64_t until = monotonicNow() + budget;
    while (!simplexes_.empty()) {
        const ThreadedSimplex& last = *simplexes_.back();
        if (!last.beside_->waitForEnd(until)) {
            return "thread " + last.beside_->name() + " of " + last.path() +
                   " does not return from communicate()";
        }
        simplexes_.pop_back();
    }
    return {};
}

}  // namespace cortex::cs
