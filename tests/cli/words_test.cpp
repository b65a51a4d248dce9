// SPDX-License-Identifier: Apache-2.0
#include "text/words.hpp"

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

using Split = std::vector<std::string>;

TEST(Words, AreSplitAtBlanksOutsideOfQuotes) {
    EXPECT_EQ(splitWords("set  /arm\tgain=0.5\r"), (Split{"set", "/arm", "gain=0.5"}));
    EXPECT_EQ(splitWords("set /arm \"weights=0.1 0.2\" 'a \"b\"'"),
              (Split{"set", "/arm", "weights=0.1 0.2", "a \"b\""}));
    EXPECT_EQ(splitWords("a\\ b c=\"\\\"\" '\\' \"\""), (Split{"a b", "c=\"", "\\", ""}));
    EXPECT_EQ(splitWords(" \t "), Split{});
}

TEST(Words, EndAtARemarkThatBeginsAWord) {
    EXPECT_EQ(splitWords("list # all"), Split{"list"});
    EXPECT_EQ(splitWords("set /arm name=a#b '#c'"), (Split{"set", "/arm", "name=a#b", "#c"}));
}

TEST(Words, NeedTheEndOfAQuote) {
    EXPECT_FALSE(splitWords("set /arm 'name").has_value());
    EXPECT_FALSE(splitWords("\"it's").has_value());
}

}  // namespace
}  // namespace cortex::cli
