// SPDX-License-Identifier: Apache-2.0
// Does a loop notice who watches it? The lateness of a loop of 10,000 items at 1 kHz, in turn with
// a bare sleeper: alone, with 50 processes that look at everything (49 at 30 Hz, one at every
// cycle), and with 50 that send a command a second.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "alternating_clock.hpp"
#include "client.hpp"
#include "subject/echo.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <string_view>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

using namespace cortex;
using namespace cortex::observers;
using profiler::Echo;

namespace {

struct Options {
    int seconds = 120, clients = 50;
};

double cpuSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
}

AlternatingClock::Measured measure(AlternatingClock& clock, const Options& options,
                                   const char* what) {
    std::this_thread::sleep_for(std::chrono::seconds{2});
    clock.take();
    const double before = cpuSeconds();
    std::this_thread::sleep_for(std::chrono::seconds{options.seconds});
    const double cpu = cpuSeconds() - before;
    const AlternatingClock::Measured measured = clock.take();
    const double loop = measured.loop.medianOfP99(), sleeper = measured.sleeper.medianOfP99();
    std::printf("%s, %zu + %zu s\n  loop     median of p99 %7.1f us; %s; %llu ticks missed\n", what,
                measured.loop.seconds.size(), measured.sleeper.seconds.size(), loop,
                measured.loop.tail().c_str(), static_cast<unsigned long long>(measured.missed));
    std::printf("  sleeper  median of p99 %7.1f us; %s\n", sleeper,
                measured.sleeper.tail().c_str());
    const double even = measured.sleeper.every(0).medianOfP99();
    const double odd = measured.sleeper.every(1).medianOfP99();
    std::printf("  ratio %.2f; null ratio %.2f; %.0f %% of a CPU in this process\n", loop / sleeper,
                std::max(even, odd) / std::min(even, odd), 100 * cpu / options.seconds);
    std::fflush(stdout);
    return measured;
}

void tell(const std::vector<std::uint64_t>& counts, int seconds, const char* what) {
    const double sum = static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0ULL));
    const auto [least, most] = std::ranges::minmax(counts);
    std::printf("  %s: %.1f a second and client, from %.1f to %.1f\n", what,
                sum / static_cast<double>(counts.size()) / seconds,
                static_cast<double>(least) / seconds, static_cast<double>(most) / seconds);
}

double nullRatio(const AlternatingClock::Measured& measured) {
    const double even = measured.sleeper.every(0).medianOfP99();
    const double odd = measured.sleeper.every(1).medianOfP99();
    return std::max(even, odd) / std::min(even, odd);
}

void judge(const char* what, const AlternatingClock::Measured& with,
           const AlternatingClock::Measured& without) {
    const double change = with.loop.medianOfP99() / with.sleeper.medianOfP99() /
                          (without.loop.medianOfP99() / without.sleeper.medianOfP99());
    const double limit = std::max({1.2, nullRatio(with), nullRatio(without)});
    std::printf("%s: the ratio changes by %.2f, allowed are %.2f: %s\n", what, change, limit,
                change <= limit ? "within noise" : "NOT within noise");
}

int run(const Options& options) {
    const int domain = 1 + getpid() % 99;
    SimplexTree tree{TypeModel::load(CORTEX_SOURCE_DIR "/profiler/subject/subject-rules.xml")};
    for (int i = 0; i < 1000; ++i) tree.add("/items/n" + std::to_string(i), "TenItems");
    tree.add<Echo>("/echo", "Partner");
    cs::ClusterCS cluster{"subject", {.priority = 80, .watchdogPeriods = 1e6}};
    cluster.addSimplexTree(tree);
    auto& clock = cluster.setTriggerSource<AlternatingClock>();
    comms::NetworkOptions network;
    network.domain = domain;
    network.interfaces = {"127.0.0.1"};
    cluster.addInterface<comms::DdsInterface>(network);
    cluster.start();
    for (const std::string& refusal : cluster.realtimeReport()) std::cout << refusal << '\n';

    const auto alone = measure(clock, options, "alone");
    Clients clients;
    for (int i = 0; i < options.clients; ++i) {
        clients.start(i, i == 0 ? Load::ViewEvery : Load::View30, domain);
    }
    clients.waitUntilReady();
    const auto watched = measure(clock, options, "watched");
    tell(clients.stop(), options.seconds, "images");
    for (int i = 0; i < options.clients; ++i) clients.start(i, Load::Command, domain);
    clients.waitUntilReady();
    const auto commanded = measure(clock, options, "commanded");
    tell(clients.stop(), options.seconds, "commands");
    judge("watched", watched, alone);
    judge("commanded", commanded, alone);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 5 && std::string_view{argv[1]} == "--client") {
            return runClient(std::atoi(argv[2]), static_cast<Load>(std::atoi(argv[3])),
                             std::atoi(argv[4]));
        }
        Options options;
        if (argc > 1) options.seconds = std::atoi(argv[1]);
        if (argc > 2) options.clients = std::atoi(argv[2]);
        if (argc > 3 || options.seconds < 4 || options.clients < 1) {
            std::cerr << "usage: cortex-observers [SECONDS of each part [CLIENTS]]\n";
            return 2;
        }
        return run(options);
    } catch (const std::exception& error) {
        std::cerr << "error: " << error.what() << '\n';
        return 1;
    }
}
