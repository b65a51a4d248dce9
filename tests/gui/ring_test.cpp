// SPDX-License-Identifier: Apache-2.0
#include "record/ring.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::gui {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// All that was put, by its index.
Extent bruteForce(const std::vector<double>& all, std::int64_t from, std::int64_t to) {
    Extent result;
    for (std::int64_t i = from; i < to; ++i) result.add(all[static_cast<std::size_t>(i)]);
    return result;
}

struct Filled {
    explicit Filled(std::size_t count, std::int64_t first = 0) {
        std::mt19937 random{7};
        std::normal_distribution<double> values;
        all.assign(static_cast<std::size_t>(first), none);
        while (all.size() < count) {
            const bool gap = random() % 50 == 0;
            const std::size_t length = gap ? random() % 300 : 1;
            for (std::size_t i = 0; i < length && all.size() < count; ++i) {
                all.push_back(gap ? none : values(random));
            }
        }
        all.push_back(1);
        for (std::size_t i = static_cast<std::size_t>(first); i < all.size(); ++i) {
            if (!std::isnan(all[i])) ring.put(static_cast<std::int64_t>(i), all[i], 0);
        }
    }

    std::vector<double> all;
    Ring ring{8192};
};

TEST(Ring, FindsTheSameExtentAsALookAtEverySample) {
    const Filled filled{30'000, 37};
    const Ring& ring = filled.ring;
    ASSERT_EQ(ring.end() - ring.begin(), 8192);
    std::mt19937 random{11};
    for (int i = 0; i < 2'000; ++i) {
        auto from = ring.begin() + static_cast<std::int64_t>(random() % 8192);
        auto to = ring.begin() + static_cast<std::int64_t>(random() % 8193);
        if (from > to) std::swap(from, to);
        const Extent expected = bruteForce(filled.all, from, to);
        const Extent found = ring.extent(from, to);
        ASSERT_EQ(found.any(), expected.any()) << from << " to " << to;
        ASSERT_EQ(found.missing, expected.missing) << from << " to " << to;
        if (found.any()) {
            ASSERT_EQ(found.min, expected.min);
            ASSERT_EQ(found.max, expected.max);
        }
    }
}

TEST(Ring, FindsWhereValuesBeginAndEnd) {
    const Filled filled{20'000};
    const Ring& ring = filled.ring;
    const auto missing = [&](std::int64_t i) {
        return std::isnan(filled.all[static_cast<std::size_t>(i)]);
    };
    for (std::int64_t from = ring.begin(); from < ring.end(); from += 7) {
        std::int64_t present = from, gap = from, behind = from;
        while (present < ring.end() && missing(present)) ++present;
        while (gap < ring.end() && !missing(gap)) ++gap;
        while (behind > ring.begin() && missing(behind - 1)) --behind;
        ASSERT_EQ(ring.nextPresent(from, ring.end()), present);
        ASSERT_EQ(ring.nextMissing(from, ring.end()), gap);
        ASSERT_EQ(ring.behindPresent(from), behind);
    }
}

TEST(Ring, KeepsTheNewestSamplesAndForgetsTheOldest) {
    Ring ring{256};
    for (std::int64_t i = 100; i < 1'000; ++i) ring.put(i, static_cast<double>(i), 0);
    EXPECT_EQ(ring.begin(), 744);
    EXPECT_EQ(ring.end(), 1'000);
    EXPECT_EQ(ring.value(744), 744);
    EXPECT_TRUE(std::isnan(ring.value(743)));
    EXPECT_EQ(ring.extent(0, 2'000).min, 744);
}

TEST(Ring, SamplesThatDidNotComeAreMissing) {
    Ring ring{256};
    ring.put(5, 1, 0);
    ring.put(9, 2, 0);
    EXPECT_EQ(ring.end() - ring.begin(), 5);
    EXPECT_TRUE(std::isnan(ring.value(7)));
    EXPECT_EQ(ring.quality(7), Ring::notCome);
    EXPECT_EQ(ring.nextMissing(5, 10), 6);
    EXPECT_EQ(ring.nextPresent(6, 10), 9);
    ring.put(9 + 256, 3, 0);
    EXPECT_EQ(ring.end() - ring.begin(), 256);
    EXPECT_EQ(ring.nextPresent(ring.begin(), ring.end()), 9 + 256);
    ring.put(7, 8, 0);
    EXPECT_TRUE(std::isnan(ring.value(7))) << "what is past does not change";
}

TEST(Ring, AnAbsenceLongerThanItsRoomBeginsItAnew) {
    Ring ring{256};
    ring.put(5, 1, 0);
    ring.put(1'000'000'000, 2, 0);
    EXPECT_EQ(ring.begin(), 1'000'000'000);
    EXPECT_EQ(ring.extent(0, 2'000'000'000).max, 2);
    EXPECT_EQ(ring.extent(0, 2'000'000'000).min, 2);
}

TEST(Ring, ASampleOfTenMinutesTakesAsManyBytesAsIsReckoned) {
    const Ring ring;
    EXPECT_LE(ring.bytes(), Ring::full * Ring::bytesOfASample);
    EXPECT_GT(ring.bytes(), Ring::full * (Ring::bytesOfASample - 1));
}

}  // namespace
}  // namespace cortex::gui
