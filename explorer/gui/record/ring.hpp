// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

namespace cortex::gui {

inline constexpr double missingValue = std::numeric_limits<double>::quiet_NaN();

// What the samples of a stretch have in common. Without any value, `min` is above `max`.
struct Extent {
    double min, max;
    bool missing = false;  // at least one
    bool unfit = false;    // at least one came, but was not good
    bool absent = false;   // at least one did not come

    Extent();
    bool any() const { return min <= max; }
    void add(double value);  // NaN: it is missing
    void add(const Extent& other);
};

// The newest samples of one line by their index, which grows by one a cycle. Beside the values it
// keeps minimum and maximum of 16, 256, … of them, so that long stretches are drawn at once.
class Ring {
public:
    static constexpr std::size_t fanOut = 16, levelCount = 4;
    static constexpr std::size_t block = 65'536;       // fanOut to the power of levelCount
    static constexpr std::size_t full = 10 * block;    // 10 minutes at 1 kHz
    static constexpr std::uint8_t notCome = 0xff;      // instead of a quality
    static constexpr std::size_t bytesOfASample = 11;  // with its share of the extents, rounded up

    explicit Ring(std::size_t capacity = full);  // a multiple of 16; of `block` in the program

    std::int64_t begin() const { return begin_; }  // index of the oldest sample
    std::int64_t end() const { return end_; }      // behind the newest one
    std::size_t capacity() const { return capacity_; }
    std::size_t bytes() const;
    std::int64_t present() const { return present_; }  // samples that have a value

    // The sample of an index not below end(); those between have not come. NaN: it is missing.
    void put(std::int64_t index, double value, std::uint8_t quality);

    double value(std::int64_t index) const;  // NaN: missing, or no longer kept
    std::uint8_t quality(std::int64_t index) const;
    Extent extent(std::int64_t from, std::int64_t to) const;  // without `to`
    // The first index from `from` on that has a value; `to` if there is none before it.
    std::int64_t nextPresent(std::int64_t from, std::int64_t to) const;
    // The first index from `from` on that has none; `to` if there is none before it.
    std::int64_t nextMissing(std::int64_t from, std::int64_t to) const;
    // The index behind the last value before `from`; begin() if there is none.
    std::int64_t behindPresent(std::int64_t from) const;

private:
    struct Level {
        std::int64_t width = 1;  // samples of one extent
        std::unique_ptr<Extent[]> extents;
    };
    std::size_t slot(std::int64_t index) const {
        return static_cast<std::size_t>(index) % capacity_;
    }
    void append(double value, std::uint8_t quality);
    void addTo(Extent& extent, std::size_t slot) const;
    // The widest level of which a whole extent begins at `index` and ends at `to` or before.
    int levelAt(std::int64_t index, std::int64_t to) const;
    const Extent& extentAt(int level, std::int64_t index) const;

    std::size_t capacity_;
    std::int64_t begin_ = 0, end_ = 0, present_ = 0;
    std::unique_ptr<double[]> values_;
    std::unique_ptr<std::uint8_t[]> qualities_;
    std::array<Level, levelCount> levels_;
};

}  // namespace cortex::gui
