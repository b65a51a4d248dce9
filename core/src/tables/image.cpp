// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/core/image_pool.hpp"

#include "tables/lookup.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

namespace cortex {

namespace {

constexpr std::size_t alignment = 64;

std::size_t strideFor(std::size_t octets) {
    return (octets + alignment - 1) / alignment * alignment;
}

}  // namespace

Image::Image(Image&& other) noexcept
    : pool_{std::exchange(other.pool_, nullptr)}, slot_{other.slot_} {}

Image& Image::operator=(Image&& other) noexcept {
    if (this == &other) return *this;
    release();
    pool_ = std::exchange(other.pool_, nullptr);
    slot_ = other.slot_;
    return *this;
}

Image::~Image() { release(); }

void Image::release() {
    if (pool_ == nullptr) return;
    pool_->slots_[slot_].pins.fetch_sub(1);
    pool_->pinned_.fetch_sub(1);
    pool_ = nullptr;
}

const ImagePool& Image::pool() const {
    if (pool_ == nullptr) throw Error("this image is empty: check it before use");
    return *pool_;
}

std::int64_t Image::cycle() const { return pool().slots_[slot_].cycle; }
std::int64_t Image::nominalTime() const { return pool().slots_[slot_].nominalTime; }
std::int64_t Image::wallClock() const { return pool().slots_[slot_].wallClock; }
const Structure& Image::structure() const { return pool().tables_.structure(); }

Slice Image::slice(std::uint32_t simplex) const {
    return pool().tables_.sliceIn(pool().slots_[slot_].memory, simplex);
}

Slice Image::constants(std::uint32_t simplex) const { return pool().tables_.constants(simplex); }

SlotState Image::state(std::uint32_t simplex) const { return *slice(simplex).state; }

Quality Image::quality(std::string_view path) const {
    return state(simplexAt(structure(), path)).quality;
}

const void* Image::cells(std::uint32_t simplex, const ItemLayout& item) const {
    const Tables& tables = pool().tables_;
    const Slice from = item.constant ? tables.constants(simplex)
                                     : tables.sliceIn(pool().slots_[slot_].memory, simplex);
    return from.at(item.item->kind, item.offset);
}

const void* Image::element(std::string_view path, std::string_view item, Kind kind) const {
    const std::uint32_t simplex = simplexAt(structure(), path);
    const ItemLayout& layout = itemAt(structure().simplexes[simplex], item);
    if (layout.item->kind != kind || layout.item->length != 1) {
        throw Error(std::string{path} + ": item '" + layout.item->name + "' is " +
                    shapeOf(*layout.item) + ", not one " + name(kind));
    }
    return cells(simplex, layout);
}

Value Image::value(std::uint32_t simplex, const ItemLayout& item) const {
    return loadValue(*item.item, cells(simplex, item));
}

Value Image::value(std::string_view path, std::string_view item) const {
    const std::uint32_t simplex = simplexAt(structure(), path);
    return value(simplex, itemAt(structure().simplexes[simplex], item));
}

std::uint32_t imagesToKeep(std::size_t octets) {
    constexpr std::size_t memory = std::size_t{4} << 20U, fewest = 4, most = 32;
    const std::size_t fitting = memory / std::max<std::size_t>(octets, 1);
    return static_cast<std::uint32_t>(std::bit_floor(std::clamp(fitting, fewest, most)));
}

ImagePool::ImagePool(Tables& tables, std::uint32_t readers) : tables_{tables}, readers_{readers} {
    makeSlots();
}

void ImagePool::makeSlots() {
    const std::uint32_t count = readers_ + 2;
    const std::size_t stride = strideFor(tables_.arena().size());
    const std::size_t octets = stride * count + alignment;
    memory_ = std::make_unique<std::byte[]>(octets);  // zeroed: every page is touched
    slots_ = std::make_unique<Slot[]>(count);
    void* first = memory_.get();
    std::size_t room = octets;
    std::align(alignment, stride * count, first, room);
    for (std::uint32_t i = 0; i < count; ++i) {
        slots_[i].memory = static_cast<std::byte*>(first) + i * stride;
    }
    next_ = 0;
    publish(0, 0, 0);
}

// The images in the queue, and the one that the follower looks at.
void ImagePool::follow(std::uint32_t depth) {
    if (followed_ != nullptr) throw Error("these images have a follower already");
    if (pinned_.load() != 0) throw Error("an image is held: follow before the first is read");
    if (depth == 0) throw Error("a follower needs room for at least one image");
    readers_ += depth + 1;
    makeSlots();
    followed_ = std::make_unique<SpscRing<std::uint32_t>>(depth);
}

void ImagePool::queue(std::uint32_t slot) {
    std::uint32_t* place = followed_->free();
    const bool hasPlace = place != nullptr && pinned_.fetch_add(1) < readers_;
    if (!hasPlace) {
        if (place != nullptr) pinned_.fetch_sub(1);
        lost_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    slots_[slot].pins.fetch_add(1);
    *place = slot;
    followed_->push();
}

Image ImagePool::next() {
    const std::uint32_t* slot = followed_ != nullptr ? followed_->front() : nullptr;
    if (slot == nullptr) return {};
    Image image{this, *slot};
    followed_->pop();
    return image;
}

// Texts hardly ever change: a slot that holds them as they are keeps them.
void ImagePool::copyTables(Slot& slot) {
    const std::span<const std::byte> arena = tables_.arena();
    const auto [texts, octets] = tables_.textsInArena();
    const std::size_t afterTexts = texts + octets;
    std::memcpy(slot.memory, arena.data(), texts);
    std::memcpy(slot.memory + afterTexts, arena.data() + afterTexts, arena.size() - afterTexts);
    const std::uint64_t changes = textChanges();
    if (std::exchange(slot.textChanges, changes) == changes) return;
    std::memcpy(slot.memory + texts, arena.data() + texts, octets);
}

void ImagePool::publish(std::int64_t cycle, std::int64_t nominalTime, std::int64_t wallClock) {
    Slot& slot = slots_[next_];
    slot.cycle = cycle;
    slot.nominalTime = nominalTime;
    slot.wallClock = wallClock;
    copyTables(slot);
    const std::uint32_t newest = next_;
    newest_.store(newest);
    cycle_.store(cycle, std::memory_order_release);
    if (followed_ != nullptr) queue(newest);
    // Of readers + 1 slots that are not the newest each reader keeps at most one: one is free, and
    // stays so, as readers pin the newest.
    next_ = 0;
    while (next_ == newest || slots_[next_].pins.load() != 0) ++next_;
}

Image ImagePool::newest() {
    if (pinned_.fetch_add(1) >= readers_) {
        pinned_.fetch_sub(1);
        return {};
    }
    for (;;) {
        const std::uint32_t slot = newest_.load();
        slots_[slot].pins.fetch_add(1);
        if (newest_.load() == slot) return {this, slot};
        slots_[slot].pins.fetch_sub(1);
    }
}

}  // namespace cortex
