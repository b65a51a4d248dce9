// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_tables.hpp"

#include "wire/simplex_values.hpp"

#include <utility>

namespace cortex::comms {
namespace {

constexpr std::uint32_t imageReaders = 16;

}  // namespace

MirrorTables::MirrorTables(std::shared_ptr<const Structure> structure, const Id& structureHash,
                           bool everyCycle)
    : structure_{std::move(structure)},
      structureHash_{structureHash},
      tables_{structure_},
      images_{tables_, imageReaders},
      simplexes_(structure_->simplexes.size()),
      everyCycle_{everyCycle} {
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) degrade(i, Quality::Lost);
    images_.publish(0, 0, 0);
}

bool MirrorTables::apply(const Block& block, Moment now) {
    if (block.epoch != structure_->epoch || block.structureHash != structureHash_) {
        ++refused_;
        return false;
    }
    if (const std::uint64_t missing = missingBefore(block); missing != 0) {
        loss_ += missing;
        markStale(Moment::max(), {});
    }
    last_ = block.sequenceNumber;
    lost_ = false;
    for (const SimplexData& each : block.simplexes) {
        if (!applySimplex(each, block, now)) ++refused_;
    }
    cycle_ = block.cycle;
    nominalTime_ = block.nominalTime;
    wallClock_ = block.wallClock;
    publish();
    return true;
}

// A cycle may be sent again, with another choice of simplexes.
std::uint64_t MirrorTables::missingBefore(const Block& block) const {
    if (last_ == 0) return 0;
    if (everyCycle_) {
        if (block.cycle <= cycle_) return 0;
        return static_cast<std::uint64_t>(block.cycle) - static_cast<std::uint64_t>(cycle_) - 1;
    }
    return block.sequenceNumber > last_ ? block.sequenceNumber - last_ - 1 : 0;
}

bool MirrorTables::applySimplex(const SimplexData& data, const Block& block, Moment now) {
    if (data.index >= simplexes_.size()) return false;
    const SimplexInfo& info = structure_->simplexes[data.index];
    if (info.remote || !misfit(data, *info.layout).empty()) return false;
    const Slice slice = tables_.live(data.index);
    // A cycle that is sent again does not become newer.
    const bool known = simplexes_[data.index].received && slice.state->quality != Quality::Lost;
    if (known && block.cycle == cycle_) return true;
    storeValues(data, *info.layout, slice);
    if (data.cause >= simplexes_.size()) slice.state->cause = noSimplex;
    const double before = static_cast<double>(block.nominalTime) - static_cast<double>(data.time);
    simplexes_[data.index] = {true, true, now, before * 1e-9};
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

void MirrorTables::markStale(Moment now, std::chrono::nanoseconds patience) {
    bool changed = false;
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        if (!simplexes_[i].received || now - patience < simplexes_[i].when) continue;
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
    last_ = 0;
    everyCycle_ = view.rate == 0;
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) {
        if (view.shows(structure_->simplexes[i].path)) continue;
        simplexes_[i].received = false;
        degrade(i, Quality::Lost);
    }
    publish();
}

std::vector<bool> MirrorTables::received() const {
    std::vector<bool> received;
    received.reserve(simplexes_.size());
    for (std::uint32_t i = 0; i < simplexes_.size(); ++i) received.push_back(this->received(i));
    return received;
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
