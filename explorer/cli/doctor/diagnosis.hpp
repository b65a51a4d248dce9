// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cortex::cli {

// One thing that was looked at: what is so, and if it should not be, what to do.
struct Diagnosis {
    enum class Level { Ok, Warning, Error };
    Level level = Level::Ok;
    std::string subject, message, remedy;
};
using Diagnoses = std::vector<Diagnosis>;

// How the kernel of this machine treats a loop that is never to wait: preemption, isolated CPUs and
// what else uses them, idle states, pages, hypervisor. `root` has its proc, sys and dev.
void examineRealTime(const std::filesystem::path& root, Diagnoses& found);

}  // namespace cortex::cli
