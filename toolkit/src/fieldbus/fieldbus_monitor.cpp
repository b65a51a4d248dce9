// SPDX-License-Identifier: Apache-2.0
#include "fieldbus/fieldbus_monitor.hpp"

#include "cortex/toolkit/fieldbus_link.hpp"

#include <algorithm>

namespace cortex::toolkit {

void FieldbusMonitor::populate() {
    for (const InputSimplex& each : inputs("devices"))
        devices_.push_back(
            {&each.state(), each.data<std::int64_t>("link"), each.data<double>("age", "ms")});
    data<std::int64_t>("deviceCount") = static_cast<std::int64_t>(devices_.size());
    open_ = data<std::int64_t>("open");
    refused_ = data<std::int64_t>("refused");
    lost_ = data<std::int64_t>("lost");
    worstAge_ = data<double>("worstAge", "ms");
}

void FieldbusMonitor::loopEnd(const Tick&) {
    const auto count = [this](auto condition) {
        return static_cast<std::int64_t>(std::ranges::count_if(devices_, condition));
    };
    const auto withLink = [&](Link link) {
        return count(
            [link](const Device& each) { return static_cast<Link>(each.link.get()) == link; });
    };
    open_ = withLink(Link::Open);
    refused_ = withLink(Link::Refused);
    lost_ = count([](const Device& each) { return each.state->quality == Quality::Lost; });
    double worst = 0;
    for (const Device& each : devices_) worst = std::max(worst, each.age.get());
    worstAge_ = worst;
    setQuality(Quality::Good);  // it vouches for what it says of the others
}

}  // namespace cortex::toolkit
