// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/service_threads.hpp"

#include "cortex/core/error.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

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

// As nobody, who has none to spare: root is not bound by the limit.
int requireAsNobody() {
    const rlimit none{1, 1};
    if (geteuid() == 0 && setuid(65534) != 0) return 3;
    if (setrlimit(RLIMIT_NPROC, &none) != 0) return 4;
    try {
        requireThreads(3, "the test");
    } catch (const Error& error) {
        std::cerr << error.what();
        return 0;
    }
    return 1;
}

TEST(Threads, ThatCannotBeStartedAreToldInWords) {
    EXPECT_NO_THROW(requireThreads(3, "the test"));
    EXPECT_EXIT(std::_Exit(requireAsNobody()), testing::ExitedWithCode(0),
                "the test needs 3 more threads, has [0-2]; no further thread can be started: "
                "allow more");
}

}  // namespace
}  // namespace cortex
