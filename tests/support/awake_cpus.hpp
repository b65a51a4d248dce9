// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "threads/realtime_thread.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

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

// Why this process may not ask for CPUs that stay awake; empty where it may. A machine without a
// driver that follows the request takes it all the same.
inline std::string whyNoAwakeCpus() {
    std::vector<std::string> report;
    const cs::AwakeCpus asked{report};
    if (report == cs::awakeReport("none")) return "";
    return report.empty() ? "" : report.front();
}

}  // namespace cortex::test
