// SPDX-License-Identifier: Apache-2.0
// What distribution costs: the loop thread, the way of a value to another agent, discovery, the
// wire, memory; beside bare Fast DDS or nothing.
#include "measure/comms.hpp"

#include "measure/comms_domain.hpp"
#include "network/figures.hpp"
#include "network/statistics.hpp"

#include <utility>

namespace cortex::network {

void Options::step(double part, const std::string& doing) const {
    if (!progress.step(part, doing)) throw Stopped{};
}

void Options::add(profiler::Quantity quantity) const {
    results.quantities.push_back(std::move(quantity));
}

void addTimes(const Options& options, profiler::Quantity quantity,
              const std::vector<std::int64_t>& times) {
    quantity.value = median(times);
    options.add(quantity);
    options.add({.id = quantity.id + "/p99",
                 .what = quantity.what + ", p99",
                 .unit = quantity.unit,
                 .value = percentile(times, 0.99)});
}

}  // namespace cortex::network

namespace cortex::profiler {
namespace {

double seconds(const RunOptions& options) { return options.quick ? 60 : 180; }

void run(const RunOptions& options, Progress& progress, Results& results) {
    const Domain domain = measurementDomain();
    const network::Options parts{options.quick ? 1 : 5,
                                 options.quick ? 3 : 10,
                                 domain.number,
                                 domain.alone,
                                 progress,
                                 results};
    results.notes.push_back("comms: " + domain.text());
    try {
        network::loopCost(parts);
        network::latency(parts);
        network::discovery(parts);
        network::wire(parts);
        network::footprint(parts);
        progress.step(1, "comms");
    } catch (const network::Stopped&) {
        return;  // what there is will be kept
    }
}

}  // namespace

const Measurement& commsMeasurement() {
    static constexpr Measurement measurement{
        "comms", "cost and latency of the network, discovery, octets, beside raw Fast DDS", seconds,
        run};
    return measurement;
}

}  // namespace cortex::profiler
