// SPDX-License-Identifier: Apache-2.0
#include "plots/time_ticks.hpp"

#include "model/shown_time.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>

namespace cortex::gui {

namespace {

constexpr std::array steps{1.0,   2.0,   5.0,   10.0,   15.0,   30.0,   60.0,
                           120.0, 300.0, 600.0, 1800.0, 3600.0, 7200.0, 21600.0};

std::int64_t nanoseconds(double seconds) {
    return static_cast<std::int64_t>(seconds) * 1'000'000'000;
}

QString clockText(double seconds, int decimals) {
    const double scale = std::pow(10.0, decimals);
    const double rounded = std::round(seconds * scale) / scale;
    const double whole = std::floor(rounded);
    QString text = shownTimeText(nanoseconds(whole), "HH:mm:ss");
    if (decimals > 0) text += QString::number(rounded - whole, 'f', decimals).mid(1);
    return text;
}

}  // namespace

double tickStep(double seconds, double most) {
    const double wanted = seconds / std::max(most, 1.0);
    for (const double step : steps) {
        if (wanted > 1.0 / 2 && step >= wanted) return step;
    }
    if (wanted > 1) return steps.back();
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        if (decade * factor >= wanted * (1 - 1e-9)) return decade * factor;
    }
    return decade * 10;
}

QList<double> timeTicks(TimeSpan span, double step) {
    QList<double> ticks;
    const auto zone = static_cast<double>(zoneOffset(nanoseconds(span.to)));
    for (double i = std::ceil((span.from + zone) / step); i * step - zone <= span.to; ++i) {
        ticks.append(i * step - zone);
    }
    return ticks;
}

QString timeText(double seconds, double step) {
    const int decimals =
        step < 1 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 1, 6) : 0;
    return clockText(seconds, decimals);
}

QString zoneText(double seconds) { return zoneName(nanoseconds(seconds)); }

QString dayText(double seconds) { return shownTimeText(nanoseconds(seconds), "yyyy-MM-dd"); }

QString dateText(TimeSpan span) {
    const auto day = [](double seconds) { return shownTimeText(nanoseconds(seconds), "MM-dd"); };
    return day(span.from) == day(span.to) ? QString{} : day(span.from);
}

QString momentText(double seconds) { return clockText(seconds, 1); }

QString durationText(double seconds) {
    if (seconds < 1) return QStringLiteral("%1 s").arg(seconds, 0, 'f', seconds < 0.1 ? 3 : 2);
    if (seconds < 100) return QStringLiteral("%1 s").arg(seconds, 0, 'f', 2);
    const auto whole = static_cast<int>(seconds);
    if (whole < 6'000) {
        return QCoreApplication::translate("Plot", "%1 min %2 s").arg(whole / 60).arg(whole % 60);
    }
    return ageText(seconds);
}

}  // namespace cortex::gui
