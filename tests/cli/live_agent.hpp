// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cortex::test {

// A network of this test's own: a domain that follows from its process, on loopback.
extern const std::string domain;
extern const std::vector<std::string> network;

std::vector<std::string> operator+(std::vector<std::string> left,
                                   const std::vector<std::string>& right);

// `cortex` on that network, with time enough.
Outcome live(const std::vector<std::string>& arguments);
// The same with --json: its output follows that schema.
nlohmann::json liveJson(const std::vector<std::string>& arguments, const std::string& schema,
                        int exit = 0);

std::vector<std::string> linesOf(const std::string& text);

// A program that runs until it is destroyed, or killed.
class Background {
public:
    explicit Background(std::vector<std::string> command);
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    void end(int signal);   // and waits for its end
    void send(int signal);  // such as SIGSTOP and SIGCONT

private:
    pid_t child_;
};

// An agent with a system file, on that network.
std::vector<std::string> agentCommand(const std::string& file);

// The system that `cortex new-system` makes: one simulated axis that a controller of this type
// moves or holds.
class CortexLive : public testing::Test {
protected:
    explicit CortexLive(const std::string& controller = "HoldAxisController");
    void start();

    const ModelFolder folder;
    std::optional<Background> agent;
};

}  // namespace cortex::test
