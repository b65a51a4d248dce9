// SPDX-License-Identifier: Apache-2.0
#include "threads/line_distance.hpp"

#include "threads/realtime_thread.hpp"

#include <gtest/gtest.h>

namespace cortex::cs {
namespace {

TEST(LineDistance, IsFoundBetweenTwoCpusOnceBothHaveTimeForIt) {
    if (usableCpus().size() < 2) GTEST_SKIP() << "one CPU";
    double line = 0;
    for (int i = 0; i < 1000 && line == 0; ++i) line = lineMicroseconds({}, 2);

    EXPECT_GT(line, 0);
    EXPECT_EQ(placeOfThisThread().cpus, usableCpus());
}

TEST(LineDistance, IsNotKnownOfOneThreadOrThreadsOfOneCpu) {
    EXPECT_EQ(lineMicroseconds({}, 1), 0);
    EXPECT_EQ(lineMicroseconds({usableCpus().front()}, 2), 0);
}

}  // namespace
}  // namespace cortex::cs
