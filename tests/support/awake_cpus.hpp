// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <system_error>

namespace cortex::test {

// How many requests for CPUs that stay awake this process holds. The limit that the kernel tells is
// that of all processes, of tests beside this one as well.
inline int awakeCpuRequests() {
    namespace fs = std::filesystem;
    int count = 0;
    std::error_code gone;
    for (const auto& file : fs::directory_iterator{"/proc/self/fd"}) {
        if (fs::read_symlink(file.path(), gone) == "/dev/cpu_dma_latency") ++count;
    }
    return count;
}

}  // namespace cortex::test
