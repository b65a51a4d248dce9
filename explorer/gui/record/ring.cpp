// SPDX-License-Identifier: Apache-2.0
#include "record/ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::gui {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

Extent::Extent() : min{infinite}, max{-infinite} {}

void Extent::add(double value) {
    if (std::isnan(value)) {
        missing = true;
        return;
    }
    min = std::min(min, value);
    max = std::max(max, value);
}

void Extent::add(const Extent& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
    missing = missing || other.missing;
    unfit = unfit || other.unfit;
    absent = absent || other.absent;
}

Ring::Ring(std::size_t capacity)
    : capacity_{capacity},
      values_{std::make_unique_for_overwrite<double[]>(capacity)},
      qualities_{std::make_unique_for_overwrite<std::uint8_t[]>(capacity)} {
    std::size_t width = 1;
    for (Level& level : levels_) {
        width *= fanOut;
        if (capacity % width != 0) break;
        level.width = static_cast<std::int64_t>(width);
        level.extents = std::make_unique<Extent[]>(capacity / width);
    }
}

std::size_t Ring::bytes() const {
    std::size_t sum = capacity_ * (sizeof(double) + sizeof(std::uint8_t));
    for (const Level& level : levels_) {
        if (level.extents)
            sum += capacity_ / static_cast<std::size_t>(level.width) * sizeof(Extent);
    }
    return sum;
}

void Ring::put(std::int64_t index, double value, std::uint8_t quality) {
    if (index < end_) return;
    const bool first = begin_ == end_;
    if (first || index - end_ >= static_cast<std::int64_t>(capacity_)) {
        begin_ = end_ = index;
        present_ = 0;
    }
    while (end_ < index) append(missingValue, notCome);
    append(value, quality);
}

void Ring::append(double value, std::uint8_t quality) {
    const std::size_t at = slot(end_);
    const bool isFull = end_ - begin_ == static_cast<std::int64_t>(capacity_);
    if (isFull && !std::isnan(values_[at])) --present_;
    if (!std::isnan(value)) ++present_;
    values_[at] = value;
    qualities_[at] = quality;
    for (Level& level : levels_) {
        if (!level.extents) break;
        Extent& extent = level.extents[at / static_cast<std::size_t>(level.width)];
        if (end_ % level.width == 0) extent = {};
        addTo(extent, at);
    }
    ++end_;
    begin_ = std::max(begin_, end_ - static_cast<std::int64_t>(capacity_));
}

void Ring::addTo(Extent& extent, std::size_t slot) const {
    extent.add(values_[slot]);
    if (!std::isnan(values_[slot])) return;
    (qualities_[slot] == notCome ? extent.absent : extent.unfit) = true;
}

double Ring::value(std::int64_t index) const {
    return index >= begin_ && index < end_ ? values_[slot(index)] : missingValue;
}

std::uint8_t Ring::quality(std::int64_t index) const {
    return index >= begin_ && index < end_ ? qualities_[slot(index)] : notCome;
}

int Ring::levelAt(std::int64_t index, std::int64_t to) const {
    int found = -1;
    for (int i = 0; i < static_cast<int>(levelCount); ++i) {
        const Level& level = levels_[static_cast<std::size_t>(i)];
        if (!level.extents || index % level.width != 0 || index + level.width > to) break;
        found = i;
    }
    return found;
}

const Extent& Ring::extentAt(int level, std::int64_t index) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    return of.extents[slot(index) / static_cast<std::size_t>(of.width)];
}

Extent Ring::extent(std::int64_t from, std::int64_t to) const {
    from = std::max(from, begin_);
    to = std::min(to, end_);
    Extent result;
    while (from < to) {
        const int level = levelAt(from, to);
        if (level < 0) {
            addTo(result, slot(from++));
        } else {
            result.add(extentAt(level, from));
            from += levels_[static_cast<std::size_t>(level)].width;
        }
    }
    return result;
}

std::int64_t Ring::nextPresent(std::int64_t from, std::int64_t to) const {
    from = std::max(from, begin_);
    const std::int64_t last = std::min(to, end_);
    while (from < last) {
        int level = levelAt(from, last);
        while (level >= 0 && extentAt(level, from).any()) --level;
        if (level < 0 && !std::isnan(values_[slot(from)])) return from;
        from += level < 0 ? 1 : levels_[static_cast<std::size_t>(level)].width;
    }
    return to;
}

std::int64_t Ring::nextMissing(std::int64_t from, std::int64_t to) const {
    from = std::max(from, begin_);
    const std::int64_t last = std::min(to, end_);
    while (from < last) {
        int level = levelAt(from, last);
        while (level >= 0 && extentAt(level, from).missing) --level;
        if (level < 0 && std::isnan(values_[slot(from)])) return from;
        from += level < 0 ? 1 : levels_[static_cast<std::size_t>(level)].width;
    }
    return to;
}

std::int64_t Ring::behindPresent(std::int64_t from) const {
    from = std::min(from, end_);
    while (from > begin_) {
        std::int64_t step = 1;
        for (const Level& level : levels_) {
            const std::int64_t start = from - level.width;
            if (!level.extents || from % level.width != 0 || start < begin_) break;
            if (level.extents[slot(start) / static_cast<std::size_t>(level.width)].any()) break;
            step = level.width;
        }
        if (step == 1 && !std::isnan(values_[slot(from - 1)])) return from;
        from -= step;
    }
    return begin_;
}

}  // namespace cortex::gui
