// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/data.hpp"
#include "cortex/core/structure.hpp"

#include <cstdint>
#include <string_view>

namespace cortex {

class ImagePool;

// One consistent copy of all tables after a cycle, pinned while this object lives; constants too.
// Any thread; never delays the loop. Reading by path costs a hash look-up. Throws Error if empty.
class Image {
public:
    Image() = default;
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;
    ~Image();

    explicit operator bool() const { return pool_ != nullptr; }
    std::int64_t cycle() const;        // 0 before the first cycle
    std::int64_t nominalTime() const;  // ns since the cluster's start
    std::int64_t wallClock() const;    // UTC ns that belongs to nominalTime
    const Structure& structure() const;

    SlotState state(std::uint32_t simplex) const;
    Quality quality(std::string_view path) const;

    // Scalar by path and item; throws Error naming the nearest names if there is none.
    template <class T>
    T get(std::string_view path, std::string_view item) const {
        using Cell = typename StorageOf<const T>::type;
        return Data<const T>{static_cast<Cell*>(element(path, item, kindFor<T>()))}.get();
    }
    Value value(std::uint32_t simplex, const ItemLayout& item) const;  // any kind, arrays too
    Value value(std::string_view path, std::string_view item) const;
    // For transports: the slices of one simplex, to read from. Constants have no state.
    Slice slice(std::uint32_t simplex) const CORTEX_REALTIME;
    Slice constants(std::uint32_t simplex) const CORTEX_REALTIME;

private:
    friend class ImagePool;
    Image(ImagePool* pool, std::uint32_t slot) : pool_{pool}, slot_{slot} {}
    const ImagePool& pool() const;  // throws if this is empty
    const void* cells(std::uint32_t simplex, const ItemLayout& item) const;
    const void* element(std::string_view path, std::string_view item, Kind kind) const;
    void release();

    ImagePool* pool_ = nullptr;
    std::uint32_t slot_ = 0;
};

}  // namespace cortex
