// SPDX-License-Identifier: Apache-2.0
#include "live/set_parts.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::cli {
namespace {

using Arguments = ProgramInterface::Arguments;

Value ints(std::size_t count) { return std::vector<std::int64_t>(count, 1); }

// The names of each part.
std::string partsOf(const Arguments& items) {
    std::string text;
    for (const Arguments& part : setParts(items)) {
        text += text.empty() ? "" : " | ";
        for (const auto& [name, value] : part) text += name;
    }
    return text;
}

TEST(SetParts, AreOneWhereAllFitsIntoADatagram) {
    EXPECT_EQ(partsOf({}), "");
    EXPECT_EQ(partsOf({{"a", ints(1)}, {"b", true}, {"c", 0.5}}), "abc");
    EXPECT_EQ(partsOf({{"a", ints(3700)}, {"b", ints(3700)}}), "ab");
}

TEST(SetParts, AreSeveralWhereItWouldNotAndLoseNothing) {
    EXPECT_EQ(partsOf({{"a", ints(3800)}, {"b", ints(3800)}}), "a | b");
    EXPECT_EQ(partsOf({{"a", ints(5000)}, {"b", ints(5000)}, {"c", 1.0}, {"d", ints(5000)}}),
              "a | bc | d");
    EXPECT_EQ(partsOf({{"a", std::vector<std::string>(15, std::string(4096, 'x'))}, {"b", true}}),
              "a | b");
}

TEST(SetParts, HaveAnItemThatIsTooLargeByItself) {
    EXPECT_EQ(partsOf({{"a", 1.0}, {"b", ints(9000)}, {"c", 1.0}, {"d", 1.0}}), "a | b | cd");
}

}  // namespace
}  // namespace cortex::cli
