// SPDX-License-Identifier: Apache-2.0
// What a plot takes of memory in the long run, without the time that it would take.
#include "plot_fixture.hpp"

#include <QFile>
#include <cstdlib>

#include <unistd.h>

namespace cortex::test {
namespace {

double residentBytes() {
    QFile file{QStringLiteral("/proc/self/statm")};
    if (!file.open(QIODevice::ReadOnly)) return 0;
    return file.readAll().split(' ').at(1).toDouble() * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// A long test keeps ten minutes, a short one the least that the program keeps.
bool isLong() { return std::getenv("CORTEX_LONG_PLOTS") != nullptr; }

class PlotMemory : public Plotted {
protected:
    PlotMemory() : Plotted{isLong() ? Ring::full : Ring::block} {}
    // Half a second each, with a gap and a late sample now and then.
    void goOnFor(std::int64_t cycles) {
        const std::int64_t end = agent.cycle() + cycles;
        for (int round = 0; agent.cycle() < end; ++round) {
            run(500, [](double seconds) { return std::sin(seconds * 7); });
            if (round % 20 == 0) agent.skip(37);
            agent.put("/switch", "mode", std::int64_t{round % 2});
            show();
        }
    }
};

TEST_F(PlotMemory, IsFlatOnceAllRingsAreFull) {
    const auto kept = static_cast<std::int64_t>(isLong() ? Ring::full : Ring::block);
    view.add({position, demand, velocity, mode});
    show();
    goOnFor(kept + 10'000);
    ASSERT_EQ(line(1).ring->end() - line(1).ring->begin(), kept) << "they are full";
    const double resident = residentBytes();
    const std::size_t recorded = recorder.bytes();
    goOnFor(isLong() ? kept : kept / 4);
    EXPECT_EQ(recorder.bytes(), recorded);
    if (isLong()) {
        EXPECT_LT(residentBytes() - resident, 1'048'576);
    }
}

}  // namespace
}  // namespace cortex::test
