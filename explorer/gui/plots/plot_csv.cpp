// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_csv.hpp"

#include "cortex/core/quality.hpp"
#include "cortex/core/value.hpp"

#include "common/csv_cell.hpp"
#include "common/utc_text.hpp"
#include "plots/lanes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <set>
#include <string>

namespace cortex::gui {

namespace {

std::string columnName(const PlotLine& line) {
    std::string name = line.item.path + '.' + line.item.item;
    if (line.data.length > 1) name += '[' + std::to_string(line.item.element) + ']';
    if (!line.model.unit.empty()) name += '[' + line.model.unit + ']';
    return common::csvCell(name);
}

constexpr double exactWhole = 9'007'199'254'740'992;  // 2^53

// A ring keeps doubles. What has more digits is written so that nobody takes it for exact.
std::string wholeText(double value) {
    if (std::abs(value) < exactWhole) return toText(static_cast<std::int64_t>(value));
    std::array<char, 32> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific);
    return {text.data(), end.ptr};
}

std::string valueOf(const DrawnLine& line, const Recorder& recorder, double value) {
    if (std::isnan(value)) return {};
    switch (line.line.data.kind) {
        case Kind::String:
            return common::csvCell(recorder.text(value));
        case Kind::Bool:
            return value != 0 ? "true" : "false";
        case Kind::Int:
            return wholeText(value);
        case Kind::Float:
            break;
    }
    return toText(value);
}

// The lines of one agent and how far they are written; agents have cycles of their own.
struct Source {
    const DrawnLine* any = nullptr;
    std::int64_t next = 0, last = 0;
    bool came(const std::vector<DrawnLine>& lines) const {
        return std::ranges::any_of(lines, [&](const DrawnLine& each) {
            return each.any() && each.time == any->time &&
                   each.ring->quality(next) != Ring::notCome;
        });
    }
};

std::vector<Source> sourcesOf(const std::vector<DrawnLine>& lines, TimeSpan span) {
    std::vector<Source> sources;
    for (const DrawnLine& each : lines) {
        if (!each.any()) continue;
        const auto from =
            static_cast<std::int64_t>(std::ceil(each.time->indexAt(span.from) - 1e-3));
        const auto to = static_cast<std::int64_t>(std::floor(each.time->indexAt(span.to) + 1e-3));
        const std::int64_t first = std::max(from, each.ring->begin());
        const std::int64_t last = std::min(to + 1, each.ring->end());
        const auto same = std::ranges::find_if(
            sources, [&](const Source& of) { return of.any->time == each.time; });
        if (same == sources.end()) {
            sources.push_back({&each, first, last});
        } else {
            same->next = std::min(same->next, first);
            same->last = std::max(same->last, last);
        }
    }
    return sources;
}

void writeRow(std::ostream& out, const Source& source, const std::vector<DrawnLine>& lines,
              const Recorder& recorder) {
    const AgentTime& time = *source.any->time;
    out << common::utcText(time.table.utcAt(source.next), 9) << ',' << time.cycleAt(source.next);
    for (const DrawnLine& each : lines) {
        const std::uint8_t quality = each.any() && each.time == source.any->time
                                         ? each.ring->quality(source.next)
                                         : Ring::notCome;
        out << ',';
        if (quality == Ring::notCome) {
            out << ',';
            continue;
        }
        out << valueOf(each, recorder, each.ring->value(source.next)) << ','
            << name(static_cast<Quality>(quality));
    }
    out << '\n';
}

}  // namespace

void writeCsv(std::ostream& out, const std::vector<DrawnLine>& lines, const Recorder& recorder,
              TimeSpan span) {
    out << "time_utc,cycle";
    for (const DrawnLine& each : lines) out << ',' << columnName(each.line) << ",quality";
    out << '\n';
    std::vector<Source> sources = sourcesOf(lines, span);
    while (true) {
        Source* earliest = nullptr;
        std::int64_t when = 0;
        for (Source& each : sources) {
            if (each.next >= each.last) continue;
            const std::int64_t utc = each.any->time->table.utcAt(each.next);
            if (earliest != nullptr && utc >= when) continue;
            earliest = &each;
            when = utc;
        }
        if (earliest == nullptr) return;
        if (earliest->came(lines)) writeRow(out, *earliest, lines, recorder);
        ++earliest->next;
    }
}

}  // namespace cortex::gui
