// SPDX-License-Identifier: Apache-2.0
// The plant examples/ds402_dual_axis at 1 kHz for a minute, also beside a build that takes all
// CPUs: what is counted is right, and a drive that answers in time is never lost. An exchange waits
// for three threads to wake up, so it may be late three times as often as one that only sleeps.
#include "cortex/comms/mirror.hpp"

#include "cli/controlled_agent.hpp"
#include "cli/live_agent.hpp"
#include "comms/inbox.hpp"
#include "modbus/sim_process.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr std::int64_t minute = 60'000;                          // cycles
constexpr double periodOfLoop = 1000, responseTimeout = 20'000;  // us
constexpr const char* clusterPath = "/ds402_dual_axis";

double rankOf(std::vector<double> values, double share) {
    if (values.empty()) return NAN;
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, place);
    return *place;
}

std::string figuresOf(const std::vector<double>& values) {
    return "p50 " + std::to_string(std::lround(rankOf(values, 0.5))) + " us, p99 " +
           std::to_string(std::lround(rankOf(values, 0.99))) + " us, longest " +
           std::to_string(std::lround(rankOf(values, 1))) + " us";
}

std::int64_t countBeyond(const std::vector<double>& values, double limit) {
    return std::ranges::count_if(values, [&](double each) { return each > limit; });
}

// A thread that sleeps until each millisecond, and notes how much later it was awake.
class BareSleeper {
public:
    BareSleeper() : thread_{[this] { run(); }} {}
    ~BareSleeper() { end(); }
    BareSleeper(const BareSleeper&) = delete;
    BareSleeper& operator=(const BareSleeper&) = delete;

    const std::vector<double>& end() {  // us
        ends_ = true;
        if (thread_.joinable()) thread_.join();
        return late_;
    }

private:
    void run() {
        for (auto due = SteadyClock::now(); !ends_; due = std::max(due + 1ms, SteadyClock::now())) {
            std::this_thread::sleep_until(due);
            late_.push_back(
                std::chrono::duration<double, std::micro>(SteadyClock::now() - due).count());
        }
    }
    std::atomic<bool> ends_{false};
    std::vector<double> late_;
    std::thread thread_;
};

// What each image of the drive says.
struct SeenOfDrive {
    std::int64_t cycle = 0, nominalTime = 0, missed = 0;
    std::int64_t stamp = 0, exchanges = 0, late = 0, errors = 0;
    double exchangeTime = 0;  // us
    Quality quality = Quality::Lost;
};

class Observer {
public:
    Observer() {
        mirror_.onImage([this](const std::string&, const comms::AgentImage& image) { see(image); });
        mirror_.view({"/drive", clusterPath}, 0);
    }
    SeenOfDrive last() const {
        const std::lock_guard lock{mutex_};
        return seen_.empty() ? SeenOfDrive{} : seen_.back();
    }
    std::vector<SeenOfDrive> since(std::int64_t cycle) const {
        const std::lock_guard lock{mutex_};
        std::vector<SeenOfDrive> all;
        std::ranges::copy_if(seen_, std::back_inserter(all),
                             [&](const SeenOfDrive& each) { return each.cycle >= cycle; });
        return all;
    }

private:
    void see(const comms::AgentImage& image) {
        const std::uint32_t axis = image->structure().find("/drive/a");
        if (!image.came(axis) || !image.came(image->structure().find(clusterPath))) return;
        const auto count = [&](const char* item) {
            return image->get<std::int64_t>("/drive", item);
        };
        const SlotState state = image->state(axis);
        const SeenOfDrive seen{image->cycle(),
                               image->nominalTime(),
                               image->get<std::int64_t>(clusterPath, "overflowCount"),
                               state.time,
                               count("exchangeCount"),
                               count("lateCount"),
                               count("errorCount"),
                               image->get<double>("/drive", "exchangeTimeLast"),
                               state.quality};
        const std::lock_guard lock{mutex_};
        seen_.push_back(seen);
    }

    mutable std::mutex mutex_;
    std::vector<SeenOfDrive> seen_;
    comms::Mirror mirror_{"observer", comms::loopback()};  // ends first: its thread calls see()
};

// How often it became lost.
std::int64_t lossesIn(const std::vector<SeenOfDrive>& all) {
    std::int64_t losses = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        losses += all[i].quality == Quality::Lost && all[i - 1].quality != Quality::Lost ? 1 : 0;
    return losses;
}

struct MinuteOfExchanges : testing::TestWithParam<bool> {
    // From the first cycle on until executed and missed ones are a minute.
    std::vector<SeenOfDrive> runsFrom(const SeenOfDrive& first) {
        const auto end = SteadyClock::now() + 60s + patience;
        SeenOfDrive now = first;
        while (now.cycle + now.missed < first.cycle + first.missed + minute &&
               SteadyClock::now() < end) {
            std::this_thread::sleep_for(20ms);
            now = observer.last();
        }
        return observer.since(first.cycle);
    }
    static void expectCountsOf(const std::vector<SeenOfDrive>& all) {
        const SeenOfDrive &first = all.front(), &last = all.back();
        const std::int64_t counted = last.cycle + last.missed - first.cycle - first.missed;
        EXPECT_GE(counted, minute);
        // What a cycle misses is counted in the next one.
        const std::int64_t passed = (last.nominalTime - first.nominalTime) / 1'000'000;
        EXPECT_LE(std::abs(counted - passed), 1) << counted << " counted, " << passed << " ms";
        std::int64_t stamps = 0, younger = 0;
        for (std::size_t i = 1; i < all.size(); ++i) {
            stamps += all[i].stamp == all[i - 1].stamp ? 0 : 1;
            younger += all[i].stamp > all[i].nominalTime || all[i].stamp < all[i - 1].stamp ? 1 : 0;
        }
        EXPECT_LE(stamps, last.exchanges - first.exchanges + 1) << "only an answer is a new stamp";
        EXPECT_EQ(younger, 0);
    }

    modbus::test::SimProcess sim{{"--axes", "2"}};
    Background agent{
        agentCommand(CORTEX_SOURCE_DIR "/examples/ds402_dual_axis/ds402_dual_axis.xml") +
        std::vector<std::string>{"--startup", "--priority", "0", "--frequency", "1000", "--set",
                                 "/drive.address=" + sim.address()}};
    Observer observer;
};

TEST_P(MinuteOfExchanges, CountsEachCycleAndNeverLosesADriveThatAnswersInTime) {
    ASSERT_TRUE(becomesTrue([&] { return observer.last().quality == Quality::Good; }));
    std::deque<Background> build;
    for (unsigned i = 0; GetParam() && i < std::thread::hardware_concurrency(); ++i)
        build.emplace_back(std::vector<std::string>{"sh", "-c", "while :; do :; done"});
    const SeenOfDrive first = observer.last();
    BareSleeper sleeper;

    const std::vector<SeenOfDrive> all = runsFrom(first);

    const std::vector<double>& slept = sleeper.end();
    expectCountsOf(all);
    const SeenOfDrive last = all.back();
    const std::int64_t overslept = countBeyond(slept, periodOfLoop);
    const std::int64_t stood = countBeyond(slept, responseTimeout / 2);
    const std::int64_t exchanges = last.exchanges - first.exchanges, late = last.late - first.late;
    EXPECT_LE(late, 3 * overslept + exchanges / 10'000 + 1);
    EXPECT_LE(last.errors - first.errors, 3 * stood);
    EXPECT_LE(lossesIn(all), 3 * stood);
    std::vector<double> times;
    for (const SeenOfDrive& each : all) times.push_back(each.exchangeTime);
    std::cout << (GetParam() ? "beside a build" : "alone") << ": " << last.cycle - first.cycle
              << " cycles, " << last.missed - first.missed << " missed; " << exchanges
              << " exchanges, " << late << " late, " << last.errors - first.errors
              << " not answered in time, lost " << lossesIn(all) << " times, " << figuresOf(times)
              << "; bare sleeper: " << slept.size() << " times, " << overslept
              << " a period late or more, " << stood << " by 10 ms or more, " << figuresOf(slept)
              << std::endl;
}

INSTANTIATE_TEST_SUITE_P(AtOneKilohertz, MinuteOfExchanges, testing::Bool(),
                         [](const auto& each) { return each.param ? "BesideABuild" : "Alone"; });

}  // namespace
}  // namespace cortex::test
