// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/machine.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace cortex {

namespace fs = std::filesystem;

std::string firstLineOf(const fs::path& file) {
    std::ifstream stream{file};
    std::string line;
    std::getline(stream, line);
    line.erase(line.find_last_not_of(" \t\r\n") + 1);
    return line;
}

std::vector<int> cpusOf(const std::string& list) {
    constexpr int most = 8192;
    std::vector<int> cpus;
    std::istringstream in{list};
    for (std::string range; std::getline(in, range, ',');) {
        std::istringstream ends{range};
        int first = 0, last = 0;
        char dash = 0;
        if (!(ends >> first)) break;
        if (!(ends >> dash >> last)) last = first;
        for (int cpu = first; cpu <= std::min(last, first + most); ++cpu) cpus.push_back(cpu);
    }
    return cpus;
}

bool hasWord(const std::string& text, const std::string& word) {
    std::istringstream in{text};
    for (std::string each; in >> each;) {
        if (each == word) return true;
    }
    return false;
}

// Asked in turn: the real-time kernel's own mark, the scheduler's setting of now, the one of the
// kernel's command line, and the version string. A dynamic kernel may differ from its version.
std::string preemption(const fs::path& root) {
    const std::string version = firstLineOf(root / "proc/version");
    if (firstLineOf(root / "sys/kernel/realtime") == "1" || hasWord(version, "PREEMPT_RT")) {
        return "PREEMPT_RT";
    }
    const std::string modes =
        firstLineOf(root / "sys/kernel/debug/sched/preempt");  // "none (full)"
    const std::size_t begin = modes.find('(');
    if (begin != std::string::npos) return modes.substr(begin + 1, modes.find(')') - begin - 1);
    std::istringstream words{firstLineOf(root / "proc/cmdline")};
    std::string stated;
    for (std::string word; words >> word;) {
        if (word.starts_with("preempt=")) stated = word.substr(8);
    }
    if (stated.empty() && hasWord(version, "PREEMPT")) return "full";
    if (stated.empty() && version.find("PREEMPT") == std::string::npos) return "voluntary";
    return stated;
}

bool isVirtualMachine(const fs::path& root) {
    std::ifstream file{root / "proc/cpuinfo"};
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("flags")) return hasWord(line, "hypervisor");
    }
    return false;
}

}  // namespace cortex
