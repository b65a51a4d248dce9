// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/service_threads.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <thread>

#include <pthread.h>

#include <gtest/gtest.h>

namespace cortex {
namespace {

struct Seen {
    std::string name;
    std::size_t stack = 0;
};

Seen newThread() {
    Seen seen;
    std::thread{[&] {
        std::array<char, 16> name{};
        pthread_getname_np(pthread_self(), name.data(), name.size());
        seen.name = name.data();
        pthread_attr_t attributes;
        pthread_getattr_np(pthread_self(), &attributes);
        pthread_attr_getstacksize(&attributes, &seen.stack);
        pthread_attr_destroy(&attributes);
    }}.join();
    return seen;
}

TEST(ServiceThreads, HaveANameAndASmallStackAndOtherThreadsHaveNot) {
    const Seen before = newThread();
    {
        const ServiceThreads named{"cortex-something"};  // one character too long: not taken
        EXPECT_EQ(newThread().name, before.name);
    }
    {
        const ServiceThreads named{"cortex-service"};
        const Seen service = newThread();
        EXPECT_EQ(service.name, "cortex-service");
        EXPECT_EQ(service.stack, 1U << 20);
    }
    const Seen after = newThread();
    EXPECT_EQ(after.name, before.name);
    EXPECT_EQ(after.stack, before.stack);
    EXPECT_GT(after.stack, 1U << 20);
}

}  // namespace
}  // namespace cortex
