// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/service_threads.hpp"

#include "cortex/core/error.hpp"

#include <future>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <pthread.h>

namespace cortex {
namespace {

constexpr std::size_t serviceStack = 1 << 20;

// What a new thread gets; returns what it was. The C library has it for the whole process.
std::size_t setStackOfNewThreads(std::size_t bytes) {
    pthread_attr_t attributes;
    if (pthread_getattr_default_np(&attributes) != 0) return 0;
    std::size_t before = 0;
    pthread_attr_getstacksize(&attributes, &before);
    if (bytes != 0) {
        pthread_attr_setstacksize(&attributes, bytes);
        pthread_setattr_default_np(&attributes);
    }
    pthread_attr_destroy(&attributes);
    return before;
}

}  // namespace

ServiceThreads::ServiceThreads(const char* name)
    : stackBefore_{setStackOfNewThreads(serviceStack)} {
    pthread_getname_np(pthread_self(), nameBefore_.data(), nameBefore_.size());
    pthread_setname_np(pthread_self(), name);  // which new threads inherit
}

ServiceThreads::~ServiceThreads() {
    pthread_setname_np(pthread_self(), nameBefore_.data());
    setStackOfNewThreads(stackBefore_);
}

void requireThreads(std::size_t number, std::string_view what) {
    std::promise<void> enough;
    const std::shared_future<void> released = enough.get_future().share();
    std::vector<std::thread> threads;
    std::string refused;
    try {
        while (threads.size() < number) threads.emplace_back([released] { released.wait(); });
    } catch (const std::system_error& error) {
        refused = threadRefused(error);
    }
    enough.set_value();
    for (std::thread& each : threads) each.join();
    if (threads.size() == number) return;
    throw Error{std::string{what} + " needs " + std::to_string(number) + " more threads, has " +
                std::to_string(threads.size()) + "; " + refused};
}

std::string threadRefused(const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) return {};
    return "no further thread can be started: allow more (ulimit -u, or TasksMax of its service)";
}

}  // namespace cortex
