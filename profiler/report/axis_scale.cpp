// SPDX-License-Identifier: Apache-2.0
#include "report/axis_scale.hpp"

#include "report/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cortex::profiler {
namespace {

constexpr double slack = 1e-9;                  // of a step, for rounding
constexpr double least = 1e-100, most = 1e100;  // so that nothing computed of them overflows
constexpr std::array roundNumbers{1.0, 2.0, 5.0, 10.0};

double decade(int exponent) { return std::pow(10.0, exponent); }
int decadeOf(double value) { return static_cast<int>(std::floor(std::log10(value))); }

double roundStep(double atLeast) {
    const double base = decade(decadeOf(atLeast));
    for (const double each : roundNumbers) {
        if (each * base >= atLeast * (1 - slack)) return each * base;
    }
    return 10 * base;
}

double roundBelow(double value) {
    const double base = decade(decadeOf(value));
    double result = base;
    for (const double each : roundNumbers) {
        if (each * base <= value * (1 + slack)) result = each * base;
    }
    return result;
}

bool equal(Span span) {
    const double size = std::max(std::abs(span.low), std::abs(span.high));
    return span.high - span.low <= std::max(1e-9 * size, least);
}

bool startsAtZero(Span data) { return data.low > 0 && data.low <= data.high / 2; }

Span logarithmicSpan(Span data, bool roundEnds) {
    if (equal(data)) data = {data.low / 2, data.high * 2};
    if (roundEnds) return {roundBelow(data.low), roundStep(data.high)};
    const double margin = std::pow(data.high / data.low, 0.03);
    return {data.low / margin, data.high * margin};
}

}  // namespace

bool drawable(double value, bool logarithmic) {
    return std::isfinite(value) && std::abs(value) <= most && (!logarithmic || value >= least);
}

std::vector<double> linearTicks(double low, double high, std::size_t wanted) {
    std::vector<double> ticks;
    if (!(high > low)) return ticks;
    const double step =
        roundStep((high - low) / static_cast<double>(std::max<std::size_t>(wanted, 1)));
    const double first = std::ceil(low / step - slack);
    const double last = std::floor(high / step + slack);
    for (double each = first; each <= last && ticks.size() < 100; ++each) {
        ticks.push_back(each * step);
    }
    return ticks;
}

std::vector<double> logarithmicTicks(double low, double high, std::size_t wanted) {
    const int first = decadeOf(low * (1 + slack)), last = decadeOf(high * (1 + slack));
    const bool few = last - first < 4;
    const int stride = 1 + (last - first) / static_cast<int>(std::max<std::size_t>(wanted, 1));
    std::vector<double> ticks;
    for (int exponent = first; exponent <= last; ++exponent) {
        if (!few && exponent % stride != 0) continue;
        for (const double each : {1.0, 2.0, 5.0}) {
            const double at = each * decade(exponent);
            const bool within = at >= low * (1 - slack) && at <= high * (1 + slack);
            if (within && (few || each == 1)) ticks.push_back(at);
        }
    }
    return ticks;
}

Span shownSpan(Span data, bool logarithmic, bool roundEnds) {
    if (logarithmic) return logarithmicSpan(data, roundEnds);
    if (equal(data)) {
        const double value = data.low;
        const double around =
            std::abs(value) <= least ? 1 : std::abs(value) * (roundEnds ? 0.25 : 0.1);
        data = {value - around, value + around};
        if (roundEnds && value >= 0) data.low = 0;
    }
    if (!roundEnds) {
        const double margin = (data.high - data.low) * 0.02;
        return {data.low - margin, data.high + margin};
    }
    if (startsAtZero(data)) data.low = 0;
    const double step = roundStep((data.high - data.low) / 6);
    return {std::floor(data.low / step + slack) * step, std::ceil(data.high / step - slack) * step};
}

std::optional<Span> widened(Span data, double at, bool logarithmic) {
    if (!drawable(at, logarithmic)) return {};
    const Span all{std::min(data.low, at), std::max(data.high, at)};
    const auto length = [&](Span span) {
        if (logarithmic) return std::log10(span.high / span.low);
        return span.high - (startsAtZero(span) ? 0 : span.low);
    };
    double own = length(data);
    if (equal(data)) own = logarithmic ? 1 : std::abs(data.high) / 2;
    return own == 0 || own >= 0.4 * length(all) ? std::optional{all} : std::nullopt;
}

double Scale::pixel(double value) const {
    const double part = logarithmic_
                            ? std::log(value / span_.low) / std::log(span_.high / span_.low)
                            : (value - span_.low) / (span_.high - span_.low);
    return from_ + part * (to_ - from_);
}

int Scale::exponent() const {
    const double size = std::max(std::abs(span_.low), std::abs(span_.high));
    if (logarithmic_ || (size < 1e6 && size >= 1e-3)) return 0;
    return static_cast<int>(std::floor(decadeOf(size) / 3.0)) * 3;
}

std::vector<Tick> Scale::ticks(std::size_t wanted) const {
    const auto places = logarithmic_ ? logarithmicTicks(span_.low, span_.high, wanted)
                                     : linearTicks(span_.low, span_.high, wanted);
    std::vector<Tick> ticks;
    const double factor = decade(exponent());
    const double step = places.size() > 1 ? (places[1] - places[0]) / factor : 1;
    const bool powers = span_.high > 1e5 || span_.low < 1e-3;
    for (const double each : places) {
        if (!logarithmic_) {
            ticks.push_back(
                {each, fixed(each / factor, std::max(0, -decadeOf(step * (1 + slack))))});
        } else if (powers) {
            const int power = decadeOf(each * (1 + slack));
            const double digit = std::round(each / decade(power));
            ticks.push_back({each, (digit > 1 ? fixed(digit, 0) + "·" : "") + powerOfTen(power)});
        } else {
            ticks.push_back({each, readable(each)});
        }
    }
    return ticks;
}

std::vector<double> Scale::lesserTicks() const {
    std::vector<double> ticks;
    if (!logarithmic_ || span_.high / span_.low > 1e7) return ticks;
    for (int exponent = decadeOf(span_.low); exponent <= decadeOf(span_.high); ++exponent) {
        for (int digit = 1; digit < 10; ++digit) {
            const double at = digit * decade(exponent);
            if (shows(at)) ticks.push_back(at);
        }
    }
    return ticks;
}

}  // namespace cortex::profiler
