// SPDX-License-Identifier: Apache-2.0
#include "toolkit/allocation_counter.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

// Whoever asserts that nothing was allocated relies on it, also under a sanitizer.
TEST(AllocationCounter, CountsWhatThisThreadAllocates) {
    const std::uint64_t before = allocationCount();

    const std::string text(1000, 'x');

    EXPECT_GT(allocationCount(), before) << text.size();
}

}  // namespace
}  // namespace cortex::toolkit::test
