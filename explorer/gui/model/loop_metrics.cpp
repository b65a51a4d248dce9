// SPDX-License-Identifier: Apache-2.0
#include "model/loop_metrics.hpp"

#include "model/item_of.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace cortex::gui {

namespace {

constexpr std::array endings{"Last", "P50", "P99", "P999", "Max"};
constexpr double wide = 10'000;
constexpr int lowest = 0, highest = 9;  // decades of µs: no item says more than 0.1 µs

QString loopText(const char* text) { return QCoreApplication::translate("LoopMetrics", text); }

const DataItem* itemNamed(const AgentFrame& agent, const std::string& name) {
    const std::uint32_t own = agent.own();
    if (own == noSimplex) return nullptr;
    const ItemLayout* layout = agent.structure->simplexes[own].layout->find(name);
    return layout == nullptr ? nullptr : layout->item;
}

// Of a figure that has no numbers.
QString whyUnknown(const AgentFrame& agent, const std::string& series) {
    if (!agent.structure) return loopText("not known: its types have not all come");
    if (itemNamed(agent, series + "Last") == nullptr) return loopText("not known: not measured");
    if (!agent.came(agent.own())) return loopText("not known: no values have come");
    return series == "commandLatency" ? loopText("no command yet")
                                      : loopText("not known: no cycle yet");
}

// An item that was never written is 0, as are percentiles until they are computed first. The
// greatest jitter may be 0 all the same, where a clock is simulated.
bool isMeasured(const AgentFrame& agent, const std::string& series, const char* ending) {
    const auto number = itemOf<double>(agent, agent.own(), series + ending).value_or(0);
    if (number > 0) return true;
    const bool percentile = std::string_view{ending}.starts_with('P');
    const char* sure = series == "commandLatency" ? "commandLatencyMax"
                       : percentile               ? "cycleDurationP50"
                                                  : "cycleDurationMax";
    return itemOf<double>(agent, agent.own(), sure).value_or(0) > 0;
}

// Great numbers without decimals, which would be noise and take room.
QString shortText(const DataItem& item, double number) {
    return std::abs(number) < wide ? numberText(item, number)
                                   : numberText(DataItem{}, std::round(number));
}

LoopFigure figureOf(const AgentFrame& agent, const std::string& series, const QString& title,
                    bool live) {
    LoopFigure figure{title, {}, {}, {}, {}};
    bool known = false;
    for (std::size_t i = 0; i < endings.size(); ++i) {
        figure.texts[i] = QStringLiteral("—");
        const DataItem* item = itemNamed(agent, series + endings[i]);
        if (item == nullptr || !agent.came(agent.own())) continue;
        figure.unit = unitText(item->unit);
        if (!isMeasured(agent, series, endings[i])) continue;
        figure.numbers[i] = itemOf<double>(agent, agent.own(), item->name);
        if (!figure.numbers[i]) continue;
        const QString text = shortText(*item, *figure.numbers[i]);
        figure.texts[i] = live ? text : bracketed(text);
        known = true;
    }
    if (!known) figure.unknown = whyUnknown(agent, series);
    return figure;
}

}  // namespace

LoopMetrics loopMetrics(const AgentFrame& agent) {
    const std::uint32_t own = agent.own();
    LoopMetrics metrics;
    metrics.live = own != noSimplex && agent.beats() && agent.quality(own) == Quality::Good;
    metrics.duty = figureOf(agent, "dutyCycle", loopText("Duty cycle"), metrics.live);
    metrics.times = {
        figureOf(agent, "cycleDuration", loopText("Cycle"), metrics.live),
        figureOf(agent, "jitter", loopText("Jitter"), metrics.live),
        figureOf(agent, "lateness", loopText("Lateness"), metrics.live),
        figureOf(agent, "commandLatency", loopText("Command latency"), metrics.live),
    };
    return metrics;
}

QString threadText(const AgentFrame& agent) {
    const std::uint32_t own = agent.own();
    if (own == noSimplex || !agent.came(own)) return {};
    const auto threads = itemOf<std::int64_t>(agent, own, "threads");
    if (!threads) return {};
    const QString cpus = plainText(itemOf<std::string>(agent, own, "cpus").value_or(""));
    const QString count = QCoreApplication::translate("LoopMetrics", "%n threads", nullptr,
                                                      static_cast<int>(*threads));
    return cpus.isEmpty() ? count : loopText("%1, pinned to CPU %2").arg(count, cpus);
}

LogAxis LogAxis::around(const std::vector<LoopFigure>& figures) {
    double least = 0, greatest = 0;
    for (const LoopFigure& each : figures) {
        for (const std::optional<double>& number : each.numbers) {
            if (!number || !std::isfinite(*number) || *number <= 0) continue;
            least = least > 0 ? std::min(least, *number) : *number;
            greatest = std::max(greatest, *number);
        }
    }
    if (greatest <= 0) return {};
    const auto decade = [](double power) {
        return static_cast<int>(std::clamp<double>(power, lowest, highest));
    };
    const int from = std::min(decade(std::floor(std::log10(least))), highest - 1);
    const int to = std::max(decade(std::ceil(std::log10(greatest))), from + 1);
    return {from, to, least < std::pow(10.0, from)};
}

LogAxis LogAxis::joined(const LogAxis& other) const {
    return {std::min(from, other.from), std::max(to, other.to), below || other.below};
}

double LogAxis::shareOf(double number) const {
    if (!(number > 0)) return 0;
    return std::clamp((std::log10(number) - from) / (to - from), 0.0, 1.0);
}

QString LogAxis::label(int power) const {
    constexpr std::array units{"µs", "ms", "s"};
    const auto unit = static_cast<std::size_t>(std::clamp(power / 3, 0, 2));
    const QString zeros{power - 3 * static_cast<int>(unit), '0'};
    const QString text = '1' + zeros + ' ' + QString::fromUtf8(units[unit]);
    return below && power == from ? QStringLiteral("≤ ") + text : text;
}

}  // namespace cortex::gui
