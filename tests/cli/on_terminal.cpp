// SPDX-License-Identifier: Apache-2.0
#include "cli/on_terminal.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include <poll.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {

OnTerminal::OnTerminal(std::vector<std::string> command, unsigned short columns,
                       unsigned short rows) {
    winsize size{rows, columns, 0, 0};
    child_ = forkpty(&terminal_, nullptr, nullptr, &size);
    if (child_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setenv("TERM", "xterm", 1);
    setenv("CORTEX_TIMEOUT", std::to_string(patience.count()).c_str(), 1);
    setenv("CORTEX_PATH", CORTEX_SOURCE_DIR "/ontology", 1);
    unsetenv("NO_COLOR");
    std::vector<char*> pointers;
    for (std::string& each : command) pointers.push_back(each.data());
    pointers.push_back(nullptr);
    execv(pointers.front(), pointers.data());
    _exit(127);
}

OnTerminal::~OnTerminal() {
    if (child_ > 0) kill(child_, SIGKILL);
    exit();
    close(terminal_);
}

bool OnTerminal::shows(const std::string& text, std::chrono::seconds within) {
    const auto end = std::chrono::steady_clock::now() + within;
    std::array<char, 4096> buffer{};
    while (output_.find(text, from_) == std::string::npos) {
        pollfd file{terminal_, POLLIN, 0};
        if (std::chrono::steady_clock::now() > end || poll(&file, 1, 1000) < 0) return false;
        if (file.revents == 0) continue;
        const ssize_t count = read(terminal_, buffer.data(), buffer.size());
        if (count <= 0) return false;
        output_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    from_ = output_.find(text, from_) + text.size();
    return true;
}

void OnTerminal::type(const std::string& keys) {
    EXPECT_EQ(write(terminal_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
}

void OnTerminal::signal(int number) { kill(child_, number); }

int OnTerminal::exit(const std::string& keys) {
    std::array<char, 4096> buffer{};
    for (std::chrono::seconds waited{0}; child_ > 0 && waitpid(child_, &status_, WNOHANG) == 0;
         ++waited) {
        if (waited == patience) {
            ADD_FAILURE() << "it does not end; it is killed. It said: " << output_;
            kill(child_, SIGKILL);
            waitpid(child_, &status_, 0);
            break;
        }
        const bool gone = !keys.empty() && write(terminal_, keys.data(), keys.size()) < 0;
        pollfd file{terminal_, POLLIN, 0};
        while (poll(&file, 1, 1000) > 0) {  // until it is silent for a second, or gone
            const ssize_t count = read(terminal_, buffer.data(), buffer.size());
            if (count <= 0) break;
            output_.append(buffer.data(), static_cast<std::size_t>(count));
        }
        if (gone || (file.revents & POLLHUP) != 0) {
            waitpid(child_, &status_, 0);
            break;
        }
    }
    child_ = 0;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
}

}  // namespace cortex::test
