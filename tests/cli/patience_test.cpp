// SPDX-License-Identifier: Apache-2.0
// How long a verb waits.
#include "live/patience.hpp"

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

using namespace std::chrono_literals;

const Patience::Moment begin{1h};

TEST(Patience, GrowsWithWhatComesWhereNobodyHasSaidHowLongToWait) {
    Patience patience{3s, true, begin};
    patience.know(0, 0, begin + 1s);
    EXPECT_EQ(patience.left(begin + 1s), 2s) << "nothing came";

    patience.know(4, 0, begin + 2s);
    EXPECT_EQ(patience.left(begin + 2s), 3s);
    patience.know(4, 0, begin + 4s);
    EXPECT_EQ(patience.left(begin + 4s), 1s) << "nothing new came";
    EXPECT_FALSE(patience.over(begin + 4999ms));
    EXPECT_TRUE(patience.over(begin + 5s));
    EXPECT_EQ(patience.whole(), 5s);
    EXPECT_EQ(patience.left(begin + 6s), 1ms);
}

TEST(Patience, GrowsWithThoseWhoWereFoundAndHaveNotSaidWhoTheyAre) {
    Patience patience{3s, true, begin};

    patience.know(0, 20, begin + 1s);
    EXPECT_EQ(patience.whole(), 13s);
    patience.know(0, 2, begin + 2s);
    EXPECT_EQ(patience.whole(), 13s) << "it does not shrink";
    patience.know(0, 600, begin + 3s);
    EXPECT_EQ(patience.whole(), 13s) << "a crowd of strangers is not waited for";
    patience.know(5, 1, begin + 12s);
    EXPECT_EQ(patience.whole(), 15s);
}

TEST(Patience, DoesNotGrowForEver) {
    Patience patience{3s, true, begin};
    for (int i = 1; i < 100; ++i) {
        patience.know(static_cast<std::uint64_t>(i), 0, begin + i * 1s);
    }

    EXPECT_EQ(patience.whole(), Patience::longest);
}

TEST(Patience, IsAsItWasAskedFor) {
    Patience patience{250ms, false, begin};

    patience.know(9, 8, begin + 200ms);

    EXPECT_TRUE(patience.over(begin + 250ms));
    EXPECT_EQ(patience.whole(), 250ms);
}

}  // namespace
}  // namespace cortex::cli
