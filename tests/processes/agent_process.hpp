// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/model_folder.hpp"

#include <csignal>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include <gtest/gtest.h>

namespace cortex::test {

// `cortex-agent` as a process, on the network of this test. It is killed with its object, and with
// the test.
class AgentProcess {
public:
    // What it prints goes to a file in `folder`, or where it is told.
    struct Outputs {
        int standard = -1, errors = -1;
    };
    AgentProcess(const ModelFolder& folder, std::filesystem::path system,
                 std::vector<std::string> options = {}, Outputs outputs = {-1, -1});
    ~AgentProcess() { kill9(); }
    AgentProcess(const AgentProcess&) = delete;
    AgentProcess& operator=(const AgentProcess&) = delete;

    void start();                          // again, after an end
    void kill9();                          // and waits for the end
    int endInOrder(int signal = SIGTERM);  // the exit code, -1 after a signal
    int waitForEnd();                      // that comes by itself; one that hangs is killed
    bool hasEnded() const;
    testing::AssertionResult prints(const std::string& text) const;  // sooner or later

    pid_t pid() const { return pid_; }
    const std::vector<pid_t>& pids() const { return pids_; }  // of all its starts
    pid_t releasePid() { return std::exchange(pid_, 0); }     // somebody else waits for its end
    std::string output() const;                               // of all its starts

private:
    std::vector<std::string> command_;
    std::filesystem::path output_;
    Outputs outputs_;
    pid_t pid_ = 0;
    std::vector<pid_t> pids_;
};

// The system file of an agent /plant of 100 Hz: /output, and at `path` a processor of this type,
// which writes it. `items`: the <data> of the type.
std::filesystem::path plantIn(const ModelFolder& folder, const std::string& path,
                              const std::string& type, const std::string& items = "");

// What a process holds.
struct Held {
    long memory = 0;  // kB, shared pages in proportion (Pss)
    std::size_t threads = 0, files = 0;
};
Held heldBy(pid_t pid);

}  // namespace cortex::test
