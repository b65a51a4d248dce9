// SPDX-License-Identifier: Apache-2.0
#include "cortex/toolkit/fieldbus_link.hpp"

#include <algorithm>
#include <string>

namespace cortex::toolkit {
namespace {

std::chrono::nanoseconds timeOf(Simplex& device, std::string_view item) {
    return std::chrono::nanoseconds{
        static_cast<std::int64_t>(device.data<const double>(item, "s") * 1e9)};
}

std::string seconds(std::chrono::nanoseconds time) {
    EventText text;
    text << static_cast<double>(time.count()) * 1e-9 << " s";
    return std::string{text.view()};
}

}  // namespace

void LinkItems::populate(Simplex& device) {
    link_ = device.data<std::int64_t>("link");
    exchanges_ = device.data<std::int64_t>("exchangeCount");
    late_ = device.data<std::int64_t>("lateCount");
    errors_ = device.data<std::int64_t>("errorCount");
    reconnects_ = device.data<std::int64_t>("reconnectCount");
    age_ = device.data<double>("age", "ms");
    timeLast_ = device.data<double>("exchangeTimeLast", "us");
    timeP99_ = device.data<double>("exchangeTimeP99", "us");
    timeMax_ = device.data<double>("exchangeTimeMax", "us");
}

void LinkItems::write(const LinkReport& report, std::int64_t age) {
    link_ = static_cast<std::int64_t>(report.link);
    exchanges_ = report.exchanges;
    late_ = report.late;
    errors_ = report.errors;
    reconnects_ = report.reconnects;
    age_ = static_cast<double>(age) * 1e-6;
    timeLast_ = report.timeLast;
    timeP99_ = report.timeP99;
    timeMax_ = report.timeMax;
}

LinkSettings LinkSettings::of(Simplex& device, std::chrono::nanoseconds period) {
    const LinkSettings settings{std::string{device.data<const std::string_view>("address").get()},
                                timeOf(device, "exchangePeriod"), timeOf(device, "responseTimeout"),
                                timeOf(device, "lossTime"), timeOf(device, "reconnectTime")};
    const std::chrono::nanoseconds between = std::max(settings.between(period), period);
    if (settings.lossTime < 2 * between) {
        throw Error(device.path() + ": lossTime is " + seconds(settings.lossTime) +
                    ", but it exchanges once in " + seconds(between) +
                    ", so that one late answer would lose it; set lossTime to at least " +
                    seconds(2 * between));
    }
    return settings;
}

}  // namespace cortex::toolkit
