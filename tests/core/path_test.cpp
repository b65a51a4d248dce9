// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/path.hpp"

#include <gtest/gtest.h>

namespace cortex {
namespace {

TEST(Path, IsAtOrBelowItselfAndWhatStandsAbove) {
    EXPECT_TRUE(isAtOrBelow("/arm", "/arm"));
    EXPECT_TRUE(isAtOrBelow("/arm/axis", "/arm"));
    EXPECT_TRUE(isAtOrBelow("/arm/axis/1", "/arm"));
}

TEST(Path, IsNotBelowANameThatItOnlyBeginsWith) {
    EXPECT_FALSE(isAtOrBelow("/army", "/arm"));
    EXPECT_FALSE(isAtOrBelow("/arm2/axis", "/arm"));
    EXPECT_FALSE(isAtOrBelow("/army", "/arm/"));
    EXPECT_FALSE(isAtOrBelow("/ar", "/arm"));
    EXPECT_FALSE(isAtOrBelow("/arm", "/arm/axis"));
    EXPECT_FALSE(isAtOrBelow("/", "/arm"));
}

TEST(Path, IsBelowTheRootHoweverThatIsWritten) {
    for (const char* root : {"/", "//", ""}) {
        EXPECT_TRUE(isAtOrBelow("/arm", root)) << root;
        EXPECT_TRUE(isAtOrBelow("/arm/axis", root)) << root;
        EXPECT_TRUE(isAtOrBelow("/", root)) << root;
    }
}

TEST(Path, TakesNoSlashAtTheEndOfAPrefixForALevel) {
    EXPECT_TRUE(isAtOrBelow("/arm", "/arm/"));
    EXPECT_TRUE(isAtOrBelow("/arm/axis", "/arm///"));
    EXPECT_EQ(withoutEndSlashes("/arm//"), "/arm");
    EXPECT_EQ(withoutEndSlashes("/"), "");
}

TEST(Path, IsNotBelowAPrefixThatIsNoPath) {
    EXPECT_FALSE(isAtOrBelow("/arm", "arm"));
    EXPECT_FALSE(isAtOrBelow("/arm", "//arm"));
    EXPECT_FALSE(isAtOrBelow("/arm/axis", "/arm//axis"));
}

}  // namespace
}  // namespace cortex
