// SPDX-License-Identifier: Apache-2.0
// What distribution costs: the loop thread, the way of a value to another agent; beside
// bare Fast DDS or nothing.
#include "measure/comms_domain.hpp"
#include "measure/measurements.hpp"
#include "network/figures.hpp"
#include "report/statistics.hpp"

#include <utility>

namespace cortex::profiler {
namespace {

std::vector<double> microseconds(const std::vector<std::int64_t>& times) {
    std::vector<double> values;
    for (const std::int64_t each : times) values.push_back(static_cast<double>(each) * 1e-3);
    return values;
}

double commsSeconds(const RunOptions& options) { return options.quick ? 30 : 90; }

void runComms(const RunOptions& options, Progress& progress, Results& results) {
    const Domain domain = measurementDomain();
    const CommsRun parts{options.quick ? 1 : 5, domain.number, progress, results};
    results.notes.push_back("comms: " + domain.text());
    try {
        measureLoopCost(parts);
        measureTransit(parts);
        progress.step(1, "comms");
    } catch (const Stopped&) {
        return;  // what there is will be kept
    }
}

}  // namespace

void CommsRun::step(double part, const std::string& doing) const {
    if (!progress.step(part, doing)) throw Stopped{};
}

double medianMicroseconds(const std::vector<std::int64_t>& times) {
    return median(microseconds(times));
}

void addTimes(const CommsRun& run, Quantity quantity, const std::vector<std::int64_t>& times) {
    quantity.value = medianMicroseconds(times);
    const std::string id = quantity.id, what = quantity.what;
    run.results.quantities.push_back(std::move(quantity));
    run.results.add(id + "/p99", what + ", p99", "us", percentile(microseconds(times), 0.99));
}

Measurement commsMeasurement() {
    return {"comms", "cost and latency of the network, beside raw Fast DDS", "Network",
            commsSeconds, runComms};
}

}  // namespace cortex::profiler
