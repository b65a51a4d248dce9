// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/data.hpp"
#include "cortex/core/structure.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace cortex {

// Octets of an item's cells.
void copyCells(Kind kind, const void* from, void* to, std::size_t octets) CORTEX_REALTIME;
void copySlice(const BlockSizes& sizes, const Slice& from, const Slice& to) CORTEX_REALTIME;

// Between values outside the tables and the cells of an item; storing sets strings' capacities. A
// value shorter than the item repeats its last element.
void storeValue(const DataItem& item, const Value& value, void* cells);
Value loadValue(const DataItem& item, const void* cells);

// All data of an agent: one contiguous block per kind and one of slot states, in one arena that is
// copied into images; constants, latches, candidates and held copies lie outside it.
// Built once, at start(). The loop's threads write it; all other threads read images.
class Tables {
public:
    explicit Tables(std::shared_ptr<const Structure> structure);

    const Structure& structure() const { return *structure_; }
    std::shared_ptr<const Structure> sharedStructure() const { return structure_; }

    Slice live(std::uint32_t simplex) const;
    std::span<SlotState> states() const;           // the live ones, by simplex
    Slice constants(std::uint32_t simplex) const;  // state is null
    // What the owner of edge `index` sees: live, latch, held copy, or its candidate to write to.
    // Setup: throws Error where it is a latch that was given up.
    Slice edge(std::uint32_t index) { return wanted(viewOf(index).seen, index); }
    // What that slice is filled from: for a held copy the live or latched source,
    // otherwise the slice itself.
    Slice edgeSource(std::uint32_t index) { return wanted(viewOf(index).source, index); }

    // What edge() gives, also where it was given up: only to compare addresses.
    Slice seen(std::uint32_t index) const { return viewOf(index).seen; }

    // A demand as it went out in the cycle before. Of several writers that is the live one until
    // the last of them has run; for a sole one a copy is made here, which the loop fills. Setup.
    Slice accepted(std::uint32_t simplex);
    // That copy; its state is null where nobody asked for one.
    Slice acceptedCopy(std::uint32_t simplex) const;
    // Whether a demand is taken by a device of this agent, as the loop says. Setup.
    bool& taken(std::uint32_t simplex);
    // The live demands count as those that went out last. Between cycles, after live ones were set.
    void acceptLive();

    // Copies every simplex that has delayed readers; at the start of a cycle.
    void latch() CORTEX_REALTIME;
    // End of setup: what nobody asked for through edge() or edgeSource() is latched no longer and
    // takes no memory, as where a delayed relationship only carries commands. From now on edge()
    // and edgeSource() write nothing: any thread of the loop may call them.
    void giveUpUnusedLatches();
    std::size_t copies() const { return extra_.size(); }  // besides the live ones

    std::span<const std::byte> arena() const { return {arena_.get(), arenaSize_}; }
    // Where the texts are in it: an offset and a number of bytes.
    std::pair<std::size_t, std::size_t> textsInArena() const;
    std::span<const std::byte> constantArena() const { return {constants_.get(), constantSize_}; }

    // The slice of a simplex in a copy of the arena (an image).
    Slice sliceIn(std::byte* arena, std::uint32_t simplex) const;

private:
    struct Latch {
        const BlockSizes* sizes;
        Slice from, to;
        bool used = false;
    };
    struct AlignedDelete {
        void operator()(std::byte* memory) const;
    };
    using Memory = std::unique_ptr<std::byte[], AlignedDelete>;

    static Memory allocate(std::size_t octets);  // zeroed: every page is touched
    Slice extraSlice(std::uint32_t simplex);     // starts as a copy of the live one
    void* cell(std::uint32_t simplex, const ItemLayout& item) const;
    void initialise();
    std::vector<Slice> makeLatches();
    // What the owner of an edge sees, and what that is filled from.
    struct View {
        Slice seen, source;
    };
    View viewOf(std::uint32_t edge) const;
    static const SlotState* stateOfCopy(const Latch& latch);
    Latch* latchOf(const Slice& slice);
    Slice wanted(const Slice& slice, std::uint32_t edge);
    void resolveEdges(const std::vector<Slice>& latches);

    std::shared_ptr<const Structure> structure_;
    Memory arena_, constants_;
    std::size_t arenaSize_ = 0, constantSize_ = 0;
    std::vector<Memory> extra_;   // latches, candidates, held and accepted copies
    std::vector<Latch> latches_;  // by the address of the copy's state
    bool gaveUp_ = false;
    std::map<std::uint32_t, Slice> accepted_;  // by simplex
    std::map<std::uint32_t, bool> taken_;      // the same
    // An index into views_; noSimplex: the live slice; givenUp: nobody asked for it in time.
    static constexpr std::uint32_t givenUp = noSimplex - 1;
    std::vector<std::uint32_t> viewOfEdge_;
    std::vector<View> views_;
};

}  // namespace cortex
