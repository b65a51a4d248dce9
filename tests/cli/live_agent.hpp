// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"

#include <chrono>
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

// A system file of one agent at 200 Hz, with these simplexes.
std::string systemFile(const ModelFolder& folder, const std::string& agent,
                       const std::string& simplexes);
// An agent with a system file, on that network.
std::vector<std::string> agentCommand(const std::string& file);

// Looks again until it is so; 20 s at most.
template <class Look, class Condition>
auto lookUntil(Look look, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{20};
    auto seen = look();
    while (!condition(seen) && std::chrono::steady_clock::now() < end) seen = look();
    return seen;
}

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
