// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "figures.hpp"
#include "roles.hpp"
#include "statistics.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <thread>

namespace cortex::network {
namespace {

// The sum of the numbers that stand after these words in a file of /proc.
double numbersOf(pid_t process, const char* file, std::initializer_list<std::string> words) {
    std::ifstream from{"/proc/" + std::to_string(process) + "/" + file};
    double sum = 0;
    for (std::string word; from >> word;) {
        double number = 0;
        if (std::ranges::find(words, word) != words.end() && from >> number) sum += number;
    }
    return sum;
}

std::string of(const Child& child) {
    const pid_t process = child.process();
    const auto handles = std::distance(
        std::filesystem::directory_iterator{"/proc/" + std::to_string(process) + "/fd"}, {});
    const double resident = numbersOf(process, "smaps_rollup", {"Rss:"});
    const double own = numbersOf(process, "smaps_rollup", {"Private_Clean:", "Private_Dirty:"});
    return text("%.1f MB, ", resident / 1024) + text("%.1f MB of its own, ", own / 1024) +
           text("%.0f threads, ", numbersOf(process, "status", {"Threads:"})) +
           text("%.0f handles", static_cast<double>(handles));
}

}  // namespace

void footprint(const Options& options) {
    heading("Memory (resident, of it not shared), threads and file handles of a process");
    progress("memory");
    AgentRole role{"a", options.domain, 18};
    Child first{wordsOf(role)};
    role.name = "b";
    Child second{wordsOf(role)};
    role.domain = -1;
    Child without{wordsOf(role)};
    Child bare{bareWords(options.domain + 1)};
    for (Child* each : {&first, &second, &without, &bare}) each->line();
    std::this_thread::sleep_for(std::chrono::seconds{options.seconds});
    row("an agent of 20 simplexes, beside another one", of(first));
    row("the same without a network", of(without));
    row("a bare participant with one writer", of(bare));
}

}  // namespace cortex::network
