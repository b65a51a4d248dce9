// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace cortex::profiler {

// Another process of this program, started with these arguments; it runs until its standard input
// ends.
class Child {
public:
    explicit Child(const std::vector<std::string>& words);
    ~Child();  // ends it and waits for it
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    // Its next line of output. Throws Error if it says none within 30 s, or that time.
    std::string line(std::chrono::milliseconds within = std::chrono::seconds{30});
    void say(const std::string& line);
    void end();  // does not wait: what it says at its end can still be read
    pid_t process() const { return process_; }

private:
    pid_t process_ = 0;
    int input_ = -1, output_ = -1;
};

// For main(), first of all: where this process is one that a measurement started, what it does
// until its standard input ends, and its exit code.
std::optional<int> playChildRole(int argc, char** argv);

bool inputEnds(int milliseconds);  // of this process, within that time

}  // namespace cortex::profiler
