// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_tables.hpp"

#include "wire/simplex_values.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::uint32_t imageReaders = 16;
// Cycles by which the first blocks of every cycle may come after one of a slower stream: those that
// the agent has kept, and on a busy machine those that are long on their way.
constexpr std::int64_t mostBehind = 10'000;

}  // namespace

MirrorTables::MirrorTables(std::shared_ptr<const Structure> structure, const Id& structureHash,
                           const MirrorView& view)
    : structure_{std::move(structure)},
      structureHash_{structureHash},
      tables_{structure_},
      images_{tables_, imageReaders},
      simplexes_(structure_->simplexes.size()) {
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        simplexes_[i].every = structure_->writtenEvery(i);
        degrade(i, Quality::Lost);
    }
    restart(view);
    published_ = 0;  // nothing has come
}

bool MirrorTables::apply(const Block& block, std::size_t stream, Moment now) {
    if (block.epoch != structure_->epoch || block.structureHash != structureHash_) {
        ++refused_;
        return false;
    }
    if (isFromBefore(block, stream)) return true;
    if (const std::uint64_t missing = missingBefore(block, stream); missing != 0) {
        loss_ += missing;
        for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
            const Arrival& each = simplexes_[i];
            if (each.received && isTakenFrom(stream, each)) degrade(i, Quality::Stale);
        }
    }
    lost_ = false;
    for (const SimplexData& each : block.simplexes) {
        if (!applySimplex(each, block, stream, now)) ++refused_;
    }
    follow(block, stream);
    publish();
    return true;
}

// When a view begins, cycles that were kept, or are on their way for long, may come after a newer
// one on a slower stream. Without them the cycles of the images do not go back.
bool MirrorTables::isFromBefore(const Block& block, std::size_t stream) const {
    if (stream != fastest_ || streams_.at(stream).last != 0) return false;
    return block.cycle < cycle_ && block.cycle >= cycle_ - mostBehind;
}

// A cycle may be sent again, with another choice of simplexes. In the stream of every cycle a gap
// in the cycles is loss, whoever left them out.
std::uint64_t MirrorTables::missingBefore(const Block& block, std::size_t stream) const {
    const Stream& before = streams_.at(stream);
    if (before.last == 0) return 0;
    if (viewRates.at(stream) == 0) {
        if (block.cycle <= before.cycle) return 0;
        return static_cast<std::uint64_t>(block.cycle) - static_cast<std::uint64_t>(before.cycle) -
               1;
    }
    return block.sequenceNumber > before.last ? block.sequenceNumber - before.last - 1 : 0;
}

// The cycle of the image is that of the fastest stream. So a plot of it has each cycle once and in
// order, whatever comes on the others. It stays so when a view begins anew: otherwise a slower one
// would give values of the cycle before a later one.
void MirrorTables::follow(const Block& block, std::size_t stream) {
    streams_.at(stream) = {block.sequenceNumber, block.cycle};
    const bool leads = stream == fastest_;
    if (!leads && (led_ || block.cycle < cycle_)) return;
    led_ = led_ || leads;
    cycle_ = block.cycle;
    nominalTime_ = block.nominalTime;
    wallClock_ = block.wallClock;
}

// Until it comes on its own stream, a simplex is taken from the one on which it came before.
bool MirrorTables::isTakenFrom(std::size_t stream, const Arrival& simplex) const {
    return simplex.stream == stream || (simplex.stream != none && !simplex.settled);
}

bool MirrorTables::applySimplex(const SimplexData& data, const Block& block, std::size_t stream,
                                Moment now) {
    if (data.index >= simplexes_.size()) return false;
    const SimplexInfo& info = structure_->simplexes[data.index];
    if (info.remote || !misfit(data, *info.layout).empty()) return false;
    Arrival& arrival = simplexes_[data.index];
    if (!isTakenFrom(stream, arrival)) return true;
    arrival.settled = arrival.stream == stream;
    const Slice slice = tables_.live(data.index);
    // A cycle that is sent again does not become newer.
    const bool known = arrival.received && slice.state->quality != Quality::Lost;
    if (known && block.cycle == arrival.cycle) return true;
    storeValues(data, *info.layout, slice);
    if (data.cause >= simplexes_.size()) slice.state->cause = noSimplex;
    const double before = static_cast<double>(block.nominalTime) - static_cast<double>(data.time);
    // What no task ever writes is as it was in the cycle that came.
    const bool measured = data.cycle != 0 || data.time != 0;
    arrival.received = arrival.ever = true;
    arrival.cycle = block.cycle;
    arrival.when = now;
    arrival.before = measured ? before * 1e-9 : 0;
    return true;
}

// False: its quality is that bad already.
bool MirrorTables::degrade(std::uint32_t simplex, Quality quality) {
    SlotState& state = *tables_.live(simplex).state;
    if (state.quality >= quality) return false;
    state.quality = quality;
    state.cause = simplex;
    return true;
}

// Each by itself: what is written seldom comes seldom. One that changes its stream has the time
// that the slowest one takes.
void MirrorTables::markStale(Moment now, std::int64_t period) {
    bool changed = false;
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        const Arrival& each = simplexes_[i];
        if (!each.received) continue;
        const std::size_t stream = each.settled ? each.stream : viewRates.size() - 1;
        if (now - each.when >= patienceOf(stream, period, each.every))
            changed = degrade(i, Quality::Stale) || changed;
    }
    if (changed) publish();
}

void MirrorTables::lose() {
    lost_ = true;
    bool changed = false;
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        changed = degrade(i, Quality::Lost) || changed;
    }
    if (changed) publish();
}

void MirrorTables::restart(const MirrorView& view) {
    streams_ = {};
    const std::size_t before = std::exchange(fastest_, none);
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        const SimplexInfo& info = structure_->simplexes[i];
        const std::size_t stream = info.remote ? none : view.streamOf(info.path).value_or(none);
        Arrival& each = simplexes_[i];
        each.settled = each.settled && stream == each.stream;
        each.stream = stream;
        fastest_ = std::min(fastest_, stream);
        if (stream != none) continue;
        each.received = false;
        degrade(i, Quality::Lost);
    }
    led_ = led_ && fastest_ == before;
    publish();
}

std::vector<bool> MirrorTables::received() const {
    std::vector<bool> received;
    received.reserve(simplexes_.size());
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) received.push_back(this->received(i));
    return received;
}

std::vector<bool> MirrorTables::behind() const {
    std::vector<bool> behind;
    behind.reserve(simplexes_.size());
    for (const Arrival& each : simplexes_) behind.push_back(each.cycle < cycle_);
    return behind;
}

std::optional<double> MirrorTables::age(std::uint32_t simplex, Moment now) const {
    if (simplex >= simplexes_.size() || !received(simplex)) return {};
    const Arrival& arrival = simplexes_[simplex];
    const std::chrono::duration<double> since = now - arrival.when;
    return since.count() + arrival.before;
}

void MirrorTables::publish() {
    ++published_;
    images_.publish(cycle_, nominalTime_, wallClock_);
}

}  // namespace cortex::comms
