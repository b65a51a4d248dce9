// SPDX-License-Identifier: Apache-2.0
#include "child.hpp"

#include "cortex/core/error.hpp"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::profiler {

Child::Child(const std::vector<std::string>& words) {
    int input[2], output[2];
    if (pipe2(input, O_CLOEXEC) != 0 || pipe2(output, O_CLOEXEC) != 0) throw Error("no pipes");
    std::string program = program_invocation_short_name;
    std::vector<char*> arguments{program.data()};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
        dup2(input[0], STDIN_FILENO);
        dup2(output[1], STDOUT_FILENO);
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    close(input[0]);
    close(output[1]);
    input_ = input[1];
    output_ = output[0];
}

void Child::say(const std::string& line) {
    const std::string text = line + "\n";
    if (write(input_, text.data(), text.size()) < 0) throw Error("a process that takes part ended");
}

void Child::end() {
    if (input_ >= 0) close(std::exchange(input_, -1));
}

Child::~Child() {
    end();
    waitpid(process_, nullptr, 0);
    close(output_);
}

std::string Child::line(std::chrono::milliseconds within) {
    std::string line;
    for (;;) {
        pollfd output{output_, POLLIN, 0};
        char next = 0;
        if (poll(&output, 1, static_cast<int>(within.count())) <= 0 ||
            read(output_, &next, 1) != 1) {
            throw Error("a process that takes part was not ready in time");
        }
        if (next == '\n') return line;
        line += next;
    }
}

bool inputEnds(int milliseconds) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    return poll(&input, 1, milliseconds) > 0;
}

}  // namespace cortex::profiler
