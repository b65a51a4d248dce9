// SPDX-License-Identifier: Apache-2.0
#include "plots/lanes.hpp"

#include "model/plain_text.hpp"

#include <algorithm>
#include <cmath>

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

std::vector<LaneWord> laneWords(const DrawnLine& line, const Recorder& recorder, TimeSpan span,
                                double pixel) {
    std::vector<LaneWord> words;
    if (!line.any() || line.ring->begin() == line.ring->end()) return words;
    const Ring& ring = *line.ring;
    const std::int64_t first = std::max(line.first(span), ring.begin());
    const std::int64_t last = std::min(line.last(span), ring.end());
    const auto step = std::max<std::int64_t>(static_cast<std::int64_t>(line.samplesOf(pixel)), 1);
    const auto add = [&](std::int64_t from, std::int64_t to, const QString& text, bool missing) {
        const double begin = line.time->secondsAt(from), end = line.time->secondsAt(to);
        if (!words.empty() && words.back().text == text && words.back().missing == missing) {
            words.back().to = end;
        } else {
            words.push_back({begin, end, text, missing});
        }
    };
    for (std::int64_t at = first - (first % step + step) % step; at < last; at += step) {
        const std::int64_t from = std::max(at, first), to = std::min(at + step, last);
        const Extent extent = ring.extent(from, to);
        if (!extent.any()) {
            add(from, to, {}, true);
        } else if (extent.min == extent.max) {
            add(from, to, wordOf(line.line, recorder, extent.min), false);
        } else {
            add(from, to, {}, false);
        }
    }
    const double newest = line.time->secondsAt(ring.end());
    if (line.silentUntil > newest) words.push_back({newest, line.silentUntil, {}, true});
    return words;
}

}  // namespace cortex::gui
