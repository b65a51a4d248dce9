// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/tables.hpp"

#include "cortex/core/error.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <new>
#include <type_traits>
#include <utility>

namespace cortex {

namespace {

constexpr std::size_t cacheLine = 64;

constexpr std::size_t aligned(std::size_t octets) {
    return (octets + cacheLine - 1) / cacheLine * cacheLine;
}

// Where each block of an arena starts; floats come first.
struct BlockOffsets {
    std::size_t ints, strings, bools, states;

    explicit BlockOffsets(const BlockSizes& totals)
        : ints{aligned(totals.floats * sizeof(double))},
          strings{aligned(ints + totals.ints * sizeof(std::int64_t))},
          bools{aligned(strings + totals.strings)},
          states{aligned(bools + totals.bools * sizeof(bool))} {}

    std::size_t size(std::size_t stateCount) const {
        return aligned(states + stateCount * sizeof(SlotState));
    }
};

Slice sliceOf(std::byte* arena, const BlockSizes& totals, const BlockSizes& base,
              std::size_t state) {
    const BlockOffsets offsets{totals};
    return {reinterpret_cast<std::int64_t*>(arena + offsets.ints) + base.ints,
            reinterpret_cast<double*>(arena) + base.floats,
            reinterpret_cast<bool*>(arena + offsets.bools) + base.bools,
            arena + offsets.strings + base.strings,
            reinterpret_cast<SlotState*>(arena + offsets.states) + state};
}

template <class T>
void copyBlock(const T* from, T* to, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count * sizeof(T));
}

bool readsOnly(const Edge& edge, const Structure& structure) {
    return edge.rule->direction == Direction::Input ||
           structure.simplexes[edge.target].role == Role::Active;
}

// A delayed edge never touches live memory, except that a delayed writer writes it.
bool readsLatch(const Edge& edge, const Structure& structure) {
    return structure.simplexes[edge.owner].role == Role::Active && readsOnly(edge, structure) &&
           (edge.delayed || structure.simplexes[edge.target].delayedOutput);
}

}  // namespace

void* Slice::at(Kind kind, std::uint32_t offset) const {
    switch (kind) {
        case Kind::Int:
            return ints + offset;
        case Kind::Float:
            return floats + offset;
        case Kind::Bool:
            return bools + offset;
        case Kind::String:
            break;
    }
    return strings + offset;
}

void copyCells(Kind kind, const void* from, void* to, std::size_t octets) {
    if (octets == 0) return;
    if (kind != Kind::String) {
        std::memcpy(to, from, octets);
    } else if (std::memcmp(to, from, octets) != 0) {
        std::memcpy(to, from, octets);
        countTextChange();
    }
}

void copySlice(const BlockSizes& sizes, const Slice& from, const Slice& to) {
    copyBlock(from.floats, to.floats, sizes.floats);
    copyBlock(from.ints, to.ints, sizes.ints);
    copyBlock(from.bools, to.bools, sizes.bools);
    copyCells(Kind::String, from.strings, to.strings, sizes.strings);
    *to.state = *from.state;
}

void storeValue(const DataItem& item, const Value& value, void* cells) {
    std::visit(
        [&](const auto& elements) {
            using Element = typename std::decay_t<decltype(elements)>::value_type;
            for (std::size_t i = 0; i < item.length; ++i) {
                const Element element =
                    elements.empty() ? Element{} : elements[std::min(i, elements.size() - 1)];
                if constexpr (std::is_same_v<Element, std::string>) {
                    auto* cell = reinterpret_cast<StringCell*>(static_cast<std::byte*>(cells) +
                                                               i * StringCell::size(item.capacity));
                    *cell = {static_cast<std::uint16_t>(item.capacity), 0, 0};
                    cell->assign(element);
                    countTextChange();
                } else {
                    static_cast<Element*>(cells)[i] = element;
                }
            }
        },
        value);
}

Value loadValue(const DataItem& item, const void* cells) {
    const auto elements = [&]<class T>(const T* first) {
        return Value{std::vector<T>(first, first + item.length)};
    };
    switch (item.kind) {
        case Kind::Int:
            return elements(static_cast<const std::int64_t*>(cells));
        case Kind::Float:
            return elements(static_cast<const double*>(cells));
        case Kind::Bool:
            return elements(static_cast<const bool*>(cells));
        case Kind::String:
            break;
    }
    std::vector<std::string> texts;
    const auto* cell = static_cast<const std::byte*>(cells);
    for (std::uint32_t i = 0; i < item.length; ++i, cell += StringCell::size(item.capacity)) {
        texts.emplace_back(reinterpret_cast<const StringCell*>(cell)->view());
    }
    return texts;
}

void Tables::AlignedDelete::operator()(std::byte* memory) const {
    ::operator delete[](memory, std::align_val_t{cacheLine});
}

Tables::Memory Tables::allocate(std::size_t octets) {
    Memory memory{new (std::align_val_t{cacheLine}) std::byte[octets]};
    std::memset(memory.get(), 0, octets);
    return memory;
}

Tables::Tables(std::shared_ptr<const Structure> structure)
    : structure_{std::move(structure)},
      arenaSize_{BlockOffsets{structure_->cyclic}.size(structure_->simplexes.size())},
      constantSize_{BlockOffsets{structure_->constant}.size(0)} {
    arena_ = allocate(arenaSize_);
    constants_ = allocate(constantSize_);
    initialise();
    resolveEdges(makeLatches());
}

void Tables::initialise() {
    const auto& simplexes = structure_->simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        // Before anybody speaks for a demand, it is safe. What a type leaves open may be one.
        const Role role = simplexes[i].layout->type->role;
        const bool linkedDemand = simplexes[i].remote && role != Role::Observation;
        for (const ItemLayout& layout : simplexes[i].layout->items) {
            const DataItem& item = *layout.item;
            const bool safe = linkedDemand && item.safe.kind == Safe::Kind::Given;
            storeValue(item, safe ? item.safe.value : item.initial, cell(i, layout));
        }
        *live(i).state = SlotState{};
        if (simplexes[i].remote) {
            live(i).state->quality = Quality::Lost;
            live(i).state->cause = i;
        }
    }
    for (const InitialValue& initial : structure_->initial) {
        storeValue(*initial.item->item, initial.value, cell(initial.simplex, *initial.item));
    }
}

const SlotState* Tables::stateOfCopy(const Latch& latch) { return latch.to.state; }

std::vector<Slice> Tables::makeLatches() {
    std::vector<Slice> latches(structure_->simplexes.size());
    for (const Edge& edge : structure_->edges) {
        Slice& latch = latches[edge.target];
        if (latch.state != nullptr || !readsLatch(edge, *structure_)) continue;
        latch = extraSlice(edge.target);
        latches_.push_back(
            {&structure_->simplexes[edge.target].layout->cyclic, live(edge.target), latch});
    }
    std::ranges::sort(latches_, std::less<>{}, stateOfCopy);
    return latches;
}

Tables::Latch* Tables::latchOf(const Slice& slice) {
    const auto latch = std::ranges::lower_bound(latches_, slice.state, std::less<>{}, stateOfCopy);
    return latch != latches_.end() && latch->to.state == slice.state ? &*latch : nullptr;
}

Slice Tables::wanted(const Slice& slice, std::uint32_t edge) {
    if (viewOfEdge_[edge] == givenUp) {
        const Edge& relation = structure_->edges[edge];
        throw Error(structure_->simplexes[relation.owner].path + ": rule '" + relation.rule->name +
                    "' is delayed: ask for data of " + structure_->simplexes[relation.target].path +
                    " in populate(), not later");
    }
    if (gaveUp_) return slice;
    if (Latch* latch = latchOf(slice); latch != nullptr) latch->used = true;
    return slice;
}

void Tables::giveUpUnusedLatches() {
    gaveUp_ = true;
    const auto isUnused = [this](const Slice& slice) {
        const Latch* latch = latchOf(slice);
        return latch != nullptr && !latch->used;
    };
    std::vector<View> kept;
    for (std::uint32_t& view : viewOfEdge_) {
        if (view == noSimplex) continue;
        if (isUnused(views_[view].seen) || isUnused(views_[view].source)) {
            view = givenUp;
            continue;
        }
        kept.push_back(views_[view]);
        view = static_cast<std::uint32_t>(kept.size() - 1);
    }
    kept.shrink_to_fit();
    views_ = std::move(kept);
    std::erase_if(extra_, [&](const Memory& memory) {
        return std::ranges::any_of(latches_, [&](const Latch& latch) {
            return !latch.used && reinterpret_cast<std::byte*>(latch.to.floats) == memory.get();
        });
    });
    std::erase_if(latches_, [](const Latch& latch) { return !latch.used; });
    latches_.shrink_to_fit();
}

void Tables::resolveEdges(const std::vector<Slice>& latches) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Slice> candidates;
    viewOfEdge_.reserve(structure_->edges.size());
    for (const Edge& edge : structure_->edges) {
        const SimplexInfo& target = structure_->simplexes[edge.target];
        const bool ownerActs = structure_->simplexes[edge.owner].role == Role::Active;
        Slice seen = readsLatch(edge, *structure_) ? latches[edge.target] : live(edge.target);
        Slice source = seen;
        if (ownerActs && !readsOnly(edge, *structure_) && target.writers.size() > 1) {
            Slice& candidate = candidates[{edge.owner, edge.target}];
            if (candidate.state == nullptr) candidate = extraSlice(edge.target);
            seen = source = candidate;
        } else if (ownerActs && edge.rule->direction == Direction::Input &&
                   edge.rule->onLoss == OnLoss::Hold) {
            seen = extraSlice(edge.target);
        }
        const bool isLive = seen.state == live(edge.target).state;
        viewOfEdge_.push_back(isLive ? noSimplex : static_cast<std::uint32_t>(views_.size()));
        if (!isLive) views_.push_back({seen, source});
    }
    views_.shrink_to_fit();
}

Tables::View Tables::viewOf(std::uint32_t edge) const {
    if (viewOfEdge_[edge] < views_.size()) return views_[viewOfEdge_[edge]];
    const Slice slice = live(structure_->edges[edge].target);
    return {slice, slice};
}

Slice Tables::extraSlice(std::uint32_t simplex) {
    const BlockSizes& sizes = structure_->simplexes[simplex].layout->cyclic;
    extra_.push_back(allocate(BlockOffsets{sizes}.size(1)));
    const Slice slice = sliceOf(extra_.back().get(), sizes, {}, 0);
    copySlice(sizes, live(simplex), slice);
    return slice;
}

Slice Tables::accepted(std::uint32_t simplex) {
    if (structure_->simplexes[simplex].writers.size() > 1) return live(simplex);
    Slice& copy = accepted_[simplex];
    if (copy.state == nullptr) copy = extraSlice(simplex);
    return copy;
}

Slice Tables::acceptedCopy(std::uint32_t simplex) const {
    const auto found = accepted_.find(simplex);
    return found == accepted_.end() ? Slice{} : found->second;
}

bool& Tables::taken(std::uint32_t simplex) {
    return taken_.try_emplace(simplex, true).first->second;
}

void Tables::acceptLive() {
    for (const auto& [simplex, copy] : accepted_) {
        copySlice(structure_->simplexes[simplex].layout->cyclic, live(simplex), copy);
    }
}

void* Tables::cell(std::uint32_t simplex, const ItemLayout& item) const {
    const Slice slice = item.constant ? constants(simplex) : live(simplex);
    return slice.at(item.item->kind, item.offset);
}

std::pair<std::size_t, std::size_t> Tables::textsInArena() const {
    return {BlockOffsets{structure_->cyclic}.strings, structure_->cyclic.strings};
}

std::span<SlotState> Tables::states() const {
    const std::size_t count = structure_->simplexes.size();
    return {count > 0 ? live(0).state : nullptr, count};
}

Slice Tables::live(std::uint32_t simplex) const { return sliceIn(arena_.get(), simplex); }

Slice Tables::constants(std::uint32_t simplex) const {
    Slice slice = sliceOf(constants_.get(), structure_->constant,
                          structure_->simplexes[simplex].constantBase, 0);
    slice.state = nullptr;
    return slice;
}

Slice Tables::sliceIn(std::byte* arena, std::uint32_t simplex) const {
    return sliceOf(arena, structure_->cyclic, structure_->simplexes[simplex].base, simplex);
}

void Tables::latch() {
    for (const Latch& latch : latches_) copySlice(*latch.sizes, latch.from, latch.to);
}

}  // namespace cortex
