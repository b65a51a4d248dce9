// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/cortex_process.hpp"
#include "core/model_folder.hpp"
#include "support/waiting.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cortex::test {

// A network of this test's own: a domain that follows from its process, on loopback.
extern const std::string domain;
inline const std::string patient = std::to_string(patience.count());  // s, for --timeout
extern const std::vector<std::string> network;

std::vector<std::string> operator+(std::vector<std::string> left,
                                   const std::vector<std::string>& right);

// `cortex` on that network, with time enough.
Outcome live(const std::vector<std::string>& arguments);
// What it printed with --json, which follows that schema.
nlohmann::json jsonOf(const Outcome& outcome, const std::string& schema, int exit = 0);
// Both of it.
nlohmann::json liveJson(const std::vector<std::string>& arguments, const std::string& schema,
                        int exit = 0);

std::vector<std::string> linesOf(const std::string& text);

// A program that runs until it is destroyed, or killed. Once one has failed that must run, no wait
// goes on.
class Background {
public:
    explicit Background(std::vector<std::string> command, bool mustRun = true);
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    void end(int signal);   // and waits for its end
    void send(int signal);  // such as SIGSTOP and SIGCONT

    bool runs() const { return howItEnded(child_).empty(); }
    std::string whyItFailed() const;  // with what it said last; empty: it has not

private:
    pid_t child_;
    int said_;  // a file of what it writes
    std::string name_;
};

// A system file of one agent at 200 Hz, with these simplexes.
std::string systemFile(const ModelFolder& folder, const std::string& agent,
                       const std::string& simplexes);
// An agent with a system file, on that network.
std::vector<std::string> agentCommand(const std::string& file);

// Looks again until it is so, while patience lasts. A look that asserts would fail at the first
// one.
template <class Look, class Condition>
auto lookUntil(Look look, Condition condition, const Place& place = Place::current()) {
    auto seen = look();
    looksUntil([&] { return condition(seen); }, [&] { seen = look(); }, place);
    return seen;
}

// Puts one text in the place of another, which must be there.
void replace(std::string& text, const std::string& old, const std::string& with);
// The system that `cortex new-system` makes, with so many cycles a second that a busy machine runs
// it, too.
std::string mixerSystem(int hertz = 100);

// How long a jog lasts without another command: the longest there is, as a busy machine sends late.
inline const char* const longHold = R"(<set data="holdTime" value="1"/>)";

// That system: one simulated axis that a controller of this type, with these items, moves or holds.
class CortexLive : public testing::Test {
protected:
    explicit CortexLive(const std::string& controller = "HoldAxisController",
                        const std::string& items = "");
    void start();

    const ModelFolder folder;
    std::optional<Background> agent;
};

}  // namespace cortex::test
