// SPDX-License-Identifier: Apache-2.0
// A signal for the end ends the process, whatever hangs in it.
#include "processes/agent_process.hpp"
#include "processes/station.hpp"
#include "support/crash_on_purpose.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto longestEnd = judgesTime ? Clock::duration{2s} : Clock::duration::max();

class EndOfAProcess : public testing::Test {
protected:
    EndOfAProcess() { system = plantIn(folder, "/stuck", "NeverReturns"); }
    ~EndOfAProcess() override { unsetenv("NEVER_RETURNS_FROM"); }

    // The exit code of one that never gets to run.
    int endOfOneThatHangsIn(const char* where) {
        setenv("NEVER_RETURNS_FROM", where, 1);
        AgentProcess agent{folder, system, options()};
        EXPECT_TRUE(agent.prints("longer than a second: "));
        const auto asked = Clock::now();
        const int code = agent.endInOrder();
        EXPECT_LT(Clock::now() - asked, longestEnd);
        output = agent.output();
        return code;
    }
    static std::vector<std::string> options() {
        return {"--plugin", CORTEX_BINARY_DIR "/lib/plugins/never-returns.so"};
    }

    ModelFolder folder;
    fs::path system;
    std::string output;
};

class EarlyEndOfAProcess : public EndOfAProcess {
protected:
    ~EarlyEndOfAProcess() override { unsetenv("ENDS_EARLY"); }

    int endOfOneThat(const char* how) {
        setenv("ENDS_EARLY", how, 1);
        fs::remove(folder.path() / "plant.txt");  // what the one before has printed
        const std::string plugin = CORTEX_BINARY_DIR "/lib/plugins/ends-early.so";
        AgentProcess agent{folder, system, {"--plugin", plugin, "--seconds", "20"}};
        const int code = agent.waitForEnd();
        output = agent.output();
        return code;
    }
    bool says(const std::string& text) const {
        if (output.find(text) != std::string::npos) return true;
        std::cerr << output;
        return false;
    }
};

TEST_F(EarlyEndOfAProcess, ByExitInAPluginHasCodeThreeAndNamesItAndItsPhase) {
    const std::string plugin =
        "plug-in " CORTEX_BINARY_DIR "/lib/plugins/ends-early.so called exit(";
    EXPECT_EQ(endOfOneThat("exit load"), 3);
    EXPECT_TRUE(says("exit(1) was called in loading the plug-in "));
    EXPECT_EQ(endOfOneThat("exit constructor"), 3);
    EXPECT_TRUE(says(plugin));
    EXPECT_TRUE(says(") in making the simplexes of "));
    EXPECT_EQ(endOfOneThat("exit populate"), 3);
    EXPECT_TRUE(
        says(") in populate() of /stuck (NeverReturns); the process ends with exit code 3"));
}

TEST_F(EarlyEndOfAProcess, ByExitWhileItsLoopRunsComesAfterTheShutdown) {
    for (const auto& [how, where] : {std::pair{"exit hook", "in stateStandby of /stuck"},
                                     std::pair{"exit thread", "in a thread of its own"}}) {
        EXPECT_EQ(endOfOneThat(how), 3);
        EXPECT_TRUE(says(std::string{where} + "; all is shut down first; the process ends with "
                                              "exit code 3"));
        EXPECT_TRUE(says("cycles in ")) << "the end of one that was shut down";
    }
    EXPECT_EQ(endOfOneThat("exit hook"), 3);
    EXPECT_TRUE(says("error /stuck fault "));
}

TEST_F(EarlyEndOfAProcess, ByACrashOutsideOfHooksNamesThePluginAndThePhase) {
    const CrashOnPurpose unreported;
    endOfOneThat("crash load");
    EXPECT_TRUE(says("cortex: SIGSEGV in loading the plug-in " CORTEX_BINARY_DIR
                     "/lib/plugins/ends-early.so; the process ends"));
    endOfOneThat("crash populate");
    EXPECT_TRUE(says("cortex: SIGSEGV in populate() of /stuck (NeverReturns) (plug-in "));
    endOfOneThat("deeper populate");
    EXPECT_TRUE(says("cortex: SIGSEGV in populate() of /stuck (NeverReturns) (plug-in "))
        << "no stack is left for the report";
    endOfOneThat("crash thread");
    EXPECT_TRUE(says("cortex: SIGSEGV in a thread of plug-in "));
}

TEST_F(EndOfAProcess, ComesWhilePopulateDoesNotReturn) {
    EXPECT_EQ(endOfOneThatHangsIn("populate"), 3);
    EXPECT_TRUE(
        output.starts_with("it takes longer than a second: populate() of /stuck (NeverReturns)\n"))
        << output;
    EXPECT_NE(output.find("hangs in populate() of /stuck (NeverReturns)"), std::string::npos)
        << output;
}

TEST_F(EndOfAProcess, OfCortexValidateIsThatOfTheStartThatItChecks) {
    setenv("NEVER_RETURNS_FROM", "populate", 1);
    const std::string tool = CORTEX_BINARY_DIR "/bin/cortex";
    const pid_t pid = fork();
    if (pid == 0) {
        execl(tool.c_str(), "cortex", "validate", system.c_str(), "--plugin",
              CORTEX_BINARY_DIR "/lib/plugins/never-returns.so", nullptr);
        _exit(1);
    }
    const std::string process = "/proc/" + std::to_string(pid);
    fs::path program;
    const auto runs = [&] {
        std::error_code gone;  // what has ended has no program
        return fs::read_symlink(program, gone).filename() == "cortex-agent";
    };
    EXPECT_TRUE(comesTrue("the start that it checks", [&] {
        std::ifstream children{process + "/task/" + std::to_string(pid) + "/children"};
        if (std::string child; children >> child) program = "/proc/" + child + "/exe";
        return runs();
    }));

    kill(pid, SIGTERM);
    int status = 0;
    waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_TRUE(comesTrue("its end", [&] { return !runs(); }));
}

TEST_F(EndOfAProcess, ComesWhileAConstructorOfAPlugInDoesNotReturn) {
    EXPECT_EQ(endOfOneThatHangsIn("constructor"), 3);
    EXPECT_NE(output.find("hangs in making the simplexes of " + system.string()), std::string::npos)
        << output;
}

TEST_F(EndOfAProcess, ComesWhileADestructorOfAPlugInDoesNotReturn) {
    setenv("NEVER_RETURNS_FROM", "destructor", 1);
    AgentProcess agent{folder, system, options()};
    ASSERT_TRUE(agent.prints("100 Hz"));
    const auto asked = Clock::now();
    EXPECT_EQ(agent.endInOrder(), 3);
    EXPECT_LT(Clock::now() - asked, longestEnd);
    EXPECT_NE(agent.output().find("hangs in the destructors of the simplexes"), std::string::npos)
        << agent.output();
}

// A pipe that is full, or a terminal that was told to wait, and nobody reads.
class Unread {
public:
    enum Kind { Pipe, Terminal };
    explicit Unread(Kind kind) { kind == Pipe ? makePipe() : makeTerminal(); }
    ~Unread() {
        close(read_);
        close(write_);
    }
    int file() const { return write_; }
    std::string read() const {  // all that is there
        std::string all(1 << 21, 0);
        const ssize_t size = ::read(read_, all.data(), all.size());
        all.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        return all;
    }

private:
    void makePipe() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) throw std::runtime_error("no pipe");
        read_ = ends[0];
        write_ = ends[1];
        const std::string much(1 << 20, '.');
        while (write(write_, much.data(), much.size()) > 0) continue;
        fcntl(write_, F_SETFL, 0);
    }
    void makeTerminal() {
        read_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (grantpt(read_) != 0 || unlockpt(read_) != 0) throw std::runtime_error("no terminal");
        write_ = open(ptsname(read_), O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (tcflow(write_, TCOOFF) != 0) throw std::runtime_error("it does not wait");
    }

    int read_ = -1, write_ = -1;
};

TEST_F(EndOfAProcess, ComesInOrderWhereNobodyReadsWhatItPrints) {
    const Unread pipe{Unread::Pipe}, terminal{Unread::Terminal};
    const int full = pipe.file(), waits = terminal.file();
    for (const AgentProcess::Outputs outputs :
         {AgentProcess::Outputs{full, -1}, {-1, full}, {full, full}, {waits, waits}}) {
        AgentProcess agent{folder, system, options(), outputs};
        {
            Station station;
            ASSERT_TRUE(station.waitFor([&] { return station.cycleOf("plant") > 5; }));
        }
        const auto asked = Clock::now();
        EXPECT_EQ(agent.endInOrder(), 0) << outputs.standard << " " << outputs.errors;
        EXPECT_LT(Clock::now() - asked, longestEnd);
    }
}

TEST_F(EndOfAProcess, TellsWhoReadsAgainHowManyLinesAreMissing) {
    const Unread pipe{Unread::Pipe};
    AgentProcess agent{folder, system, options(), {pipe.file(), -1}};
    {
        Station station;
        ASSERT_TRUE(station.waitFor([&] { return station.cycleOf("plant") > 100; })) << "1 s";
    }
    pipe.read();
    EXPECT_EQ(agent.endInOrder(), 0);
    const std::string said = pipe.read();
    EXPECT_TRUE(said.starts_with("\n(lines missing here: 1)\n")) << said;
    EXPECT_NE(said.find("cycles in "), std::string::npos) << said;
}

// The threads of a process by number, and what each is called.
std::vector<std::pair<pid_t, std::string>> threadsOf(pid_t process) {
    std::vector<std::pair<pid_t, std::string>> threads;
    for (const auto& each : fs::directory_iterator{"/proc/" + std::to_string(process) + "/task"}) {
        std::string name;
        std::getline(std::ifstream{each.path() / "comm"}, name);
        threads.emplace_back(std::stoi(each.path().filename()), name);
    }
    std::ranges::sort(threads);
    return threads;
}

// Stops one thread of a child for good, as a debugger does.
bool hold(pid_t thread) {
    return ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) == 0 &&
           ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 &&
           waitpid(thread, nullptr, __WALL) == thread;
}

// Its exit code, when the thread that is held has been waited for too; -1 after a signal.
int endOf(pid_t process) {
    int status = 0;
    const auto ended = comesTrue("the end of the process whose thread is held", [&] {
        int each = 0;
        pid_t child = 0;
        while ((child = waitpid(-1, &each, __WALL | WNOHANG)) > 0) {
            if (child == process && (WIFEXITED(each) || WIFSIGNALED(each))) status = each;
        }
        return child < 0;
    });
    EXPECT_TRUE(ended);
    if (!ended) kill(process, SIGKILL);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Of an agent that runs: holds its thread number `index`, asks it to end, and waits for that.
struct HeldEnd {
    std::string thread;  // empty: there are not so many
    int code = -1;
    Clock::duration took{};
    std::string output;
};

HeldEnd endWithAThreadHeld(const ModelFolder& folder, const fs::path& system,
                           const std::vector<std::string>& options, std::size_t index) {
    AgentProcess agent{folder, system, options};
    Station station;
    EXPECT_TRUE(station.waitFor([&] { return station.cycleOf("plant") > 5; }));
    HeldEnd end;
    const auto threads = threadsOf(agent.pid());
    if (index >= threads.size()) return end;
    end.thread = threads[index].second;
    if (!hold(threads[index].first)) return {};
    const auto asked = Clock::now();
    kill(agent.pid(), SIGTERM);
    end.code = endOf(agent.releasePid());
    end.took = Clock::now() - asked;
    end.output = agent.output();
    return end;
}

TEST_F(EndOfAProcess, ComesWithAnyOneOfItsThreadsHeld) {
    std::size_t held = 0;
    for (std::size_t index = 0;; ++index) {
        const HeldEnd end = endWithAThreadHeld(folder, system, options(), index);
        if (end.thread.empty()) break;
        ++held;
        EXPECT_TRUE(end.code == 0 || end.code == 3) << end.thread << ": " << end.code;
        EXPECT_LT(end.took, longestEnd) << end.thread << ": " << end.output;
        if (end.code == 3) {
            EXPECT_TRUE(end.output.find("hangs in ") != std::string::npos ||
                        end.output.find("does not stop") != std::string::npos)
                << end.thread << ": " << end.output;
        }
        RecordProperty(std::to_string(index) + " " + end.thread,
                       std::to_string(std::chrono::duration<double>(end.took).count()));
    }
    EXPECT_GE(held, 10U);
}

}  // namespace
}  // namespace cortex::test
