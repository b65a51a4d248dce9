// SPDX-License-Identifier: Apache-2.0
#include "roles.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "../bare/stream.hpp"
#include "measure/recording_clock.hpp"
#include "plant.hpp"

#include <chrono>
#include <cstring>

namespace cortex::profiler {
using namespace std::chrono_literals;
using Words = std::vector<std::string>;

int playAgent(const Words& words) {
    const int domain = std::stoi(words[2]);
    Plant plant{{.name = words[1], .samples = std::stoi(words[3]), .network = loopback(domain)}};
    plant.cluster.setTriggerSource<cs::InternalClock>(1ms);
    plant.start();
    inputEnds(-1);
    return 0;
}

int playSender(const Words& words) {
    const OnCpu first{0};
    const int domain = std::stoi(words[1]);
    Octets::Data data(std::stoul(words[3]));
    Stream stream{domain + 1, Stream::Role::Writer};
    Plant plant{{.name = "sender",
                 .samples = std::stoi(words[2]),
                 .network = loopback(domain),
                 .cluster = {.watchdogPeriods = 1e6}}};
    auto& clock = plant.cluster.setTriggerSource<RecordingClock>(1ms);
    RecordingPlan plan{.blocks = 120, .loopPeriods = 1000, .sleeperPeriods = 1000};
    plan.wakes = [&] {
        const std::int64_t stamp = monotonicNow();
        std::memcpy(data.data(), &stamp, sizeof stamp);
        stream.write(data);
    };
    clock.record(plan);
    plant.start();
    inputEnds(-1);
    return 0;
}

OnCpu::OnCpu(int number) {
    sched_getaffinity(0, sizeof before_, &before_);
    for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (!CPU_ISSET(cpu, &before_) || number-- > 0) continue;
        cpu_set_t only{};
        CPU_SET(cpu, &only);
        sched_setaffinity(0, sizeof only, &only);
        return;
    }
}

OnCpu::~OnCpu() { sched_setaffinity(0, sizeof before_, &before_); }

std::vector<std::string> agentWords(const std::string& name, int domain, int samples) {
    return {"--agent", name, std::to_string(domain), std::to_string(samples)};
}

std::vector<std::string> senderWords(int domain, int samples, std::size_t octets) {
    return {"--sender", std::to_string(domain), std::to_string(samples), std::to_string(octets)};
}

}  // namespace cortex::profiler
