// SPDX-License-Identifier: Apache-2.0
#include "processes/agent_process.hpp"

#include "comms/inbox.hpp"
#include "support/waiting.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::test {
namespace {

namespace fs = std::filesystem;

std::size_t entriesOf(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator{folder}, fs::directory_iterator{}));
}

}  // namespace

std::filesystem::path plantIn(const ModelFolder& folder, const std::string& path,
                              const std::string& type, const std::string& items) {
    folder.write("types.xml",
                 "<ontology name='t' version='1.0'><include file='base.xml'/><type name='" + type +
                     "' extends='Processor'>" + items + "</type></ontology>");
    folder.write("rules.xml",
                 "<morphology name='m' version='1.0'><include file='base-morphology.xml'/>"
                 "<include file='types.xml'/></morphology>");
    return folder.write("plant.xml",
                        "<system name='s'><morphology file='rules.xml'/>"
                        "<cluster name='plant' frequency='100'/>"
                        "<simplex path='/output' type='DigitalIoConcept'/><simplex path='" +
                            path + "' type='" + type +
                            "'><relate rule='outputs' to='/output'/></simplex></system>");
}

AgentProcess::AgentProcess(const ModelFolder& folder, fs::path system,
                           std::vector<std::string> options, Outputs outputs)
    : output_{folder.path() / (system.stem().string() + ".txt")}, outputs_{outputs} {
    const comms::NetworkOptions network = comms::loopback();
    command_ = {CORTEX_BINARY_DIR "/bin/cortex-agent",
                system.string(),
                "--priority",
                "0",
                "--domain",
                std::to_string(network.domain),
                "--interface",
                network.interfaces.front()};
    std::ranges::move(options, std::back_inserter(command_));
    start();
}

void AgentProcess::start() {
    std::vector<char*> arguments;
    for (std::string& each : command_) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    pids_.push_back(pid_);
    if (pid_ > 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    const int out = open(output_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(outputs_.standard >= 0 ? outputs_.standard : out, STDOUT_FILENO);
    dup2(outputs_.errors >= 0 ? outputs_.errors : out, STDERR_FILENO);
    setenv("CORTEX_PATH", CORTEX_SOURCE_DIR "/ontology", 1);
    execv(arguments.front(), arguments.data());
    _exit(127);
}

void AgentProcess::kill9() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
}

int AgentProcess::endInOrder(int signal) {
    kill(pid_, signal);
    return waitForEnd();
}

int AgentProcess::waitForEnd() {
    const auto status = statusOf(std::exchange(pid_, 0));
    EXPECT_TRUE(status) << command_[1] << " did not end in " << longestRun.count()
                        << " s, and was killed; it printed: " << output();
    return status && WIFEXITED(*status) ? WEXITSTATUS(*status) : -1;
}

bool AgentProcess::hasEnded() const { return pid_ == 0 || !howItEnded(pid_).empty(); }

testing::AssertionResult AgentProcess::prints(const std::string& text) const {
    return comesTrue(
        "the output '" + text + "'",
        [&] {
            const bool ended = hasEnded();
            if (contains(output(), text)) return true;
            if (ended) throw std::runtime_error("the agent has ended");
            return false;
        },
        [this] { return output(); });
}

std::string AgentProcess::output() const {
    std::ostringstream text;
    text << std::ifstream{output_}.rdbuf();
    return text.str();
}

Held heldBy(pid_t pid) {
    const fs::path process = fs::path{"/proc"} / std::to_string(pid);
    Held held;
    held.threads = entriesOf(process / "task");
    held.files = entriesOf(process / "fd");
    std::ifstream rollup{process / "smaps_rollup"};
    for (std::string line; std::getline(rollup, line);) {
        if (line.starts_with("Pss:")) held.memory = std::stol(line.substr(4));
    }
    return held;
}

}  // namespace cortex::test
