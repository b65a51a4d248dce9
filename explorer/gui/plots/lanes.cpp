// SPDX-License-Identifier: Apache-2.0
#include "plots/lanes.hpp"

#include "model/plain_text.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cortex::gui {

QString wordOf(const PlotLine& line, const Recorder& recorder, double number) {
    if (line.data.kind == Kind::String) {
        const QString text = plainText(recorder.text(number));
        return text.isEmpty() ? QStringLiteral("\"\"") : text;
    }
    if (line.data.kind == Kind::Bool) {
        return number != 0 ? QStringLiteral("true") : QStringLiteral("false");
    }
    const auto whole = static_cast<std::int64_t>(number);
    const auto label = line.data.labels.find(whole);
    return label == line.data.labels.end() ? QString::number(whole) : plainText(label->second);
}

double shadeOf(const PlotLine& line, double number) {
    constexpr std::int64_t mostShades = 5;  // beyond them they come again
    if (line.data.kind == Kind::Bool) return number != 0 ? 1 : 0;
    const auto whole = static_cast<std::int64_t>(number);
    const auto label = line.data.labels.find(whole);
    const auto count = static_cast<std::int64_t>(line.data.labels.size());
    const bool known = label != line.data.labels.end();
    const std::int64_t place = known ? std::distance(line.data.labels.begin(), label) : whole;
    const std::int64_t shades = known ? std::clamp<std::int64_t>(count, 2, mostShades) : mostShades;
    return static_cast<double>((place % shades + shades) % shades) /
           static_cast<double>(shades - 1);
}

std::vector<LaneWord> laneWords(const DrawnLine& line, const Recorder& recorder, TimeSpan span,
                                double pixel) {
    std::vector<LaneWord> words;
    if (!line.any() || line.ring->begin() == line.ring->end()) return words;
    const Ring& ring = *line.ring;
    const std::int64_t first = std::max(line.first(span), ring.begin());
    const std::int64_t last = std::min(line.last(span), ring.end());
    const auto step = std::max<std::int64_t>(static_cast<std::int64_t>(line.samplesOf(pixel)), 1);
    const auto add = [&](std::int64_t from, std::int64_t to, LaneWord word) {
        word.from = line.time->secondsAt(from);
        word.to = line.time->secondsAt(to);
        if (!words.empty() && words.back().text == word.text && words.back().lack == word.lack &&
            words.back().missing == word.missing) {
            words.back().to = word.to;
        } else {
            words.push_back(word);
        }
    };
    for (std::int64_t at = first - (first % step + step) % step; at < last; at += step) {
        const std::int64_t from = std::max(at, first), to = std::min(at + step, last);
        const Extent extent = ring.extent(from, to);
        if (!extent.any()) {
            add(from, to, {0, 0, {}, true, 0, lackOf(extent)});
        } else if (extent.min == extent.max) {
            add(from, to,
                {0, 0, wordOf(line.line, recorder, extent.min), false, extent.min, Lack::NoData});
        } else {
            add(from, to, {});
        }
    }
    const double newest = line.time->secondsAt(ring.end());
    if (line.silentUntil > newest) {
        words.push_back({newest, line.silentUntil, {}, true, 0, Lack::NoData});
    }
    return words;
}

}  // namespace cortex::gui
