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

struct Footprint {
    double resident, own, threads, handles;  // MB, MB not shared
};

Footprint of(const Child& child) {
    const pid_t process = child.process();
    const auto handles = std::distance(
        std::filesystem::directory_iterator{"/proc/" + std::to_string(process) + "/fd"}, {});
    return {numbersOf(process, "smaps_rollup", {"Rss:"}) / 1024,
            numbersOf(process, "smaps_rollup", {"Private_Clean:", "Private_Dirty:"}) / 1024,
            numbersOf(process, "status", {"Threads:"}), static_cast<double>(handles)};
}

void add(const Options& options, const std::string& id, const std::string& what,
         const Footprint& found, const Footprint& bare) {
    const auto one = [&](const char* part, const char* unit, double Footprint::* field) {
        options.add({.id = "comms/footprint/" + id + "/" + part,
                     .what = what + ": " + part,
                     .unit = unit,
                     .value = found.*field,
                     .baseline = bare.*field,
                     .baselineName = "a bare participant with one writer"});
    };
    one("resident", "MB", &Footprint::resident);
    one("own", "MB", &Footprint::own);
    one("threads", "threads", &Footprint::threads);
    one("handles", "handles", &Footprint::handles);
}

}  // namespace

void footprint(const Options& options) {
    options.step(0.95, "memory");
    AgentRole role{"a", options.domain, 18};
    Child first{wordsOf(role)};
    role.name = "b";
    Child second{wordsOf(role)};
    role.domain = -1;
    Child without{wordsOf(role)};
    Child bare{bareWords(options.domain + 1)};
    for (Child* each : {&first, &second, &without, &bare}) each->line();
    std::this_thread::sleep_for(std::chrono::seconds{options.seconds});
    const Footprint other = of(bare);
    add(options, "agent", "a process with an agent of 20 simplexes, beside another one", of(first),
        other);
    add(options, "alone", "the same without a network", of(without), other);
}

}  // namespace cortex::network
