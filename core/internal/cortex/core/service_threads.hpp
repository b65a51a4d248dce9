// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace cortex {

// While it lives, threads that this one starts have the name (at most 15 characters) and a stack of
// 1 MiB: those of CorteX and of Fast DDS. Locked memory counts the whole stack of each thread, and
// the usual 8 MiB are for the threads of a user's program.
class ServiceThreads {
public:
    explicit ServiceThreads(const char* name);
    ~ServiceThreads();
    ServiceThreads(const ServiceThreads&) = delete;
    ServiceThreads& operator=(const ServiceThreads&) = delete;

private:
    std::array<char, 16> nameBefore_{};
    std::size_t stackBefore_ = 0;  // bytes
};

// Throws Error where so many more threads cannot run at once, which `what` needs: in words, while
// nothing has begun. Libraries that fail to start one may end the process.
void requireThreads(std::size_t number, std::string_view what);

// What to tell a user of a thread that could not be started; "": the error is another one.
std::string threadRefused(const std::system_error& error);

}  // namespace cortex
