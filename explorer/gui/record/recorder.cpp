// SPDX-License-Identifier: Apache-2.0
#include "record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace cortex::gui {

namespace {

constexpr double second = 1e9;                     // ns
constexpr std::int64_t longestStep = 500'000'000;  // ns between two cycles, and
constexpr std::int64_t mostPeriods = 3;            // what is longer than both is a standstill
constexpr std::size_t parts = 10;                  // at most one of them goes for a gap

Ring shortened(const Ring& ring, std::size_t capacity) {
    Ring result{capacity};
    const auto kept = static_cast<std::int64_t>(capacity);
    for (std::int64_t i = std::max(ring.begin(), ring.end() - kept); i < ring.end(); ++i) {
        result.put(i, ring.value(i), ring.quality(i));
    }
    return result;
}

// Between its last cycle and this one. A busy agent that misses a few ticks does not stand still.
bool stoodStill(const AgentTime& time, std::int64_t utc) {
    const std::int64_t passed = utc - time.table.last();
    return time.table.knowsPeriod() && passed > longestStep &&
           passed > mostPeriods * time.table.period();
}

}  // namespace

double AgentTime::secondsAt(std::int64_t index) const {
    return static_cast<double>(table.utcAt(index) - clock.shift()) / second;
}

double AgentTime::indexAt(double seconds) const {
    return table.indexAt(seconds * second + static_cast<double>(clock.shift()));
}

std::int64_t AgentTime::cycleAt(std::int64_t index) const {
    const auto after = std::ranges::upper_bound(stretches, index, {}, &RecordedStretch::first);
    return after == stretches.begin() ? index : index - (after - 1)->offset;
}

void Recorder::record(const void* viewer, std::vector<RecordedItem> items) {
    if (items.empty()) {
        wanted_.erase(viewer);
    } else {
        wanted_[viewer] = std::move(items);
    }
    std::vector<RecordedItem> all = wanted();
    std::erase_if(rings_,
                  [&](const auto& each) { return !std::ranges::binary_search(all, each.first); });
    std::erase_if(times_, [&](const auto& each) {
        return std::ranges::none_of(all, [&](const auto& of) { return of.agent == each.first; });
    });
    pending_.record(std::move(all));
    fit();
}

std::vector<RecordedItem> Recorder::wanted() const {
    std::set<RecordedItem> all;
    for (const auto& [who, wanted] : wanted_) all.insert(wanted.begin(), wanted.end());
    return {all.begin(), all.end()};
}

// The oldest samples of all lines give way, in whole blocks, so that all together fit.
void Recorder::fit() {
    const std::size_t lines = std::max<std::size_t>(wanted().size(), 1);
    const std::size_t sample = Ring::bytesOfASample;
    const std::size_t blocks = limit_ / lines / sample / Ring::block;
    allowed_ = std::max(blocks, std::size_t{1}) * Ring::block;
    for (auto& [item, ring] : rings_) {
        if (ring.capacity() > capacity()) ring = gui::shortened(ring, capacity());
    }
}

void Recorder::take() {
    const auto rows = pending_.take();
    if (rows.empty()) return;
    for (const PendingRows& each : rows) add(each);
    texts_ = pending_.texts();
}

// Cycles are counted on from those before. A later start, or what follows a standstill, lies behind
// them by as many cycles as would have fitted between the two, or as there is room for.
void Recorder::begin(AgentTime& time, const PendingRows& rows, std::size_t row) {
    const std::int64_t cycle = rows.cycles[row], utc = rows.utc[row];
    std::int64_t first = cycle;
    if (!time.stretches.empty()) {
        const std::int64_t late = (utc - time.table.last()) / time.table.period();
        const auto most = static_cast<std::int64_t>(capacity() / parts);
        first = time.end + std::clamp<std::int64_t>(late, 1, most);
    }
    const bool goesOn = !time.stretches.empty() && time.stretches.back().epoch == rows.epoch;
    time.stretches.push_back({first, first - cycle, rows.epoch});
    time.table.startAnew(first, utc, goesOn ? time.table.period() : 0);
}

void Recorder::forgetOld(AgentTime& time) const {
    const std::int64_t oldest = time.end - static_cast<std::int64_t>(capacity());
    time.table.forgetBefore(oldest);
    auto& all = time.stretches;
    const auto after = std::ranges::upper_bound(all, oldest, {}, &RecordedStretch::first);
    if (after - all.begin() > 1) all.erase(all.begin(), after - 1);
}

// A line begins where every cycle comes: a sample alone before it is of a slower view.
void Recorder::put(Ring& ring, std::int64_t index, double value, std::uint8_t quality) const {
    const bool came = quality != Ring::notCome;
    const bool alone = ring.end() - ring.begin() == 1;
    if (alone && (!came || index > ring.end())) ring = Ring{capacity()};
    if (came || ring.begin() != ring.end()) ring.put(index, value, quality);
}

void Recorder::add(const PendingRows& rows) {
    AgentTime& time = times_[rows.agent];
    std::vector<Ring*> rings;
    for (const RecordedItem& each : rows.items) {
        auto found = rings_.find(each);
        const bool wanted = std::ranges::any_of(wanted_, [&](const auto& viewer) {
            return std::ranges::find(viewer.second, each) != viewer.second.end();
        });
        if (found == rings_.end() && wanted) found = rings_.try_emplace(each, capacity()).first;
        rings.push_back(wanted ? &found->second : nullptr);
    }
    for (std::size_t row = 0; row < rows.cycles.size(); ++row) {
        const bool other = time.stretches.empty() || time.stretches.back().epoch != rows.epoch;
        const std::int64_t cycles = rows.cycles[row] - time.lastCycle;
        if (!other && cycles <= 0) continue;
        // Where cycles were lost as well, these are the gap.
        const bool stood = !other && cycles == 1 && stoodStill(time, rows.utc[row]);
        if (other || stood) begin(time, rows, row);
        const std::int64_t index = rows.cycles[row] + time.stretches.back().offset;
        if (!other && !stood) {
            const bool begins = time.end == time.stretches.front().first + 1;
            if (!begins) time.skipped += static_cast<std::uint64_t>(cycles - 1);
            time.table.add(index, rows.utc[row], (rows.nominal[row] - time.lastNominal) / cycles);
        }
        time.clock.add(rows.utc[row], rows.came[row]);
        time.lastCycle = rows.cycles[row];
        time.lastNominal = rows.nominal[row];
        time.end = index + 1;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            const std::size_t at = row * rings.size() + i;
            if (rings[i] != nullptr) put(*rings[i], index, rows.values[at], rows.qualities[at]);
        }
    }
    forgetOld(time);
}

const Ring* Recorder::ring(const RecordedItem& item) const {
    const auto found = rings_.find(item);
    return found == rings_.end() ? nullptr : &found->second;
}

const AgentTime* Recorder::time(const std::string& agent) const {
    const auto found = times_.find(agent);
    return found == times_.end() ? nullptr : &found->second;
}

std::string Recorder::text(double number) const {
    if (!(number >= 0) || number >= static_cast<double>(texts_.size())) return {};
    return texts_[static_cast<std::size_t>(number)];
}

std::size_t Recorder::bytes() const {
    std::size_t sum = 0;
    for (const auto& [item, ring] : rings_) sum += ring.bytes();
    return sum;
}

}  // namespace cortex::gui
