// SPDX-License-Identifier: Apache-2.0
#include "cli/live_agent.hpp"

#include "cli/json_schema.hpp"
#include "support/own_domain.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::test {

using nlohmann::json;

namespace {

std::set<const Background*>& running() {
    static std::set<const Background*> all;
    return all;
}

std::string whyOneFailed() {
    for (const Background* each : running()) {
        if (std::string why = each->whyItFailed(); !why.empty()) return why;
    }
    return {};
}

}  // namespace

const std::string domain = std::to_string(ownDomain());
const std::vector<std::string> network{"--domain", domain, "--interface", "127.0.0.1"};

std::vector<std::string> operator+(std::vector<std::string> left,
                                   const std::vector<std::string>& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

Outcome live(const std::vector<std::string>& arguments) {
    if (const std::string why = whyOneFailed(); !why.empty()) return {-1, "", why};
    Outcome outcome = cortex(arguments + network + std::vector<std::string>{"--timeout", patient});
    seenLast = [words = testing::PrintToString(arguments), outcome] {
        return words + " ended with " + std::to_string(outcome.exit) + ":\n" + outcome.output +
               outcome.errors;
    };
    return outcome;
}

json jsonOf(const Outcome& outcome, const std::string& schema, int exit) {
    EXPECT_EQ(outcome.exit, exit) << outcome.output << outcome.errors;
    EXPECT_EQ(violationsOf(schema, outcome.output), "") << outcome.output;
    return json::parse(outcome.output, nullptr, false);
}

json liveJson(const std::vector<std::string>& arguments, const std::string& schema, int exit) {
    return jsonOf(live(arguments + std::vector<std::string>{"--json"}), schema, exit);
}

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream{text};
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

Background::Background(std::vector<std::string> command, bool mustRun)
    : child_{0}, said_{memfd_create("said", MFD_CLOEXEC)}, name_{testing::PrintToString(command)} {
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ > 0) {
        if (mustRun) running().insert(this);
        hopeless = whyOneFailed;
        return;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    for (const int file : {STDOUT_FILENO, STDERR_FILENO}) dup2(said_, file);
    setenv("CORTEX_PATH", CORTEX_SOURCE_DIR "/ontology", 1);
    std::vector<char*> pointers;
    for (std::string& each : command) pointers.push_back(each.data());
    pointers.push_back(nullptr);
    execv(pointers.front(), pointers.data());
    _exit(127);
}

Background::~Background() {
    end(SIGTERM);
    close(said_);
}

void Background::end(int signal) {
    if (child_ == 0) return;
    running().erase(this);
    kill(child_, signal);
    kill(child_, SIGCONT);  // what was stopped ends, too
    waitpid(child_, nullptr, 0);
    child_ = 0;
}

void Background::send(int signal) {
    if (child_ != 0) kill(child_, signal);
}

std::string Background::whyItFailed() const {
    const std::string how = howItEnded(child_);
    if (how.empty() || how == "ended with code 0") return {};
    std::array<char, 4096> last{};
    struct stat file{};
    fstat(said_, &file);
    const auto count = pread(said_, last.data(), last.size(),
                             std::max<off_t>(file.st_size - static_cast<off_t>(last.size()), 0));
    return name_ + " " + how + ": " +
           std::string(last.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
}

std::string systemFile(const ModelFolder& folder, const std::string& agent,
                       const std::string& simplexes) {
    return folder
        .write(agent + ".xml", "<system name=\"" + agent +
                                   "\"><morphology file=\"robotics-morphology.xml\"/>"
                                   "<cluster name=\"" +
                                   agent + "\" frequency=\"200\"/>" + simplexes + "</system>")
        .string();
}

std::vector<std::string> agentCommand(const std::string& file) {
    return std::vector<std::string>{CORTEX_BINARY_DIR "/bin/cortex-agent", file} + network;
}

void replace(std::string& text, const std::string& old, const std::string& with) {
    const std::size_t place = text.find(old);
    if (place == std::string::npos) throw std::runtime_error{"no '" + old + "' in the system"};
    text.replace(place, old.size(), with);
}

std::string mixerSystem(int hertz) {
    std::string system = cortex({"new-system", "mixer"}).output;
    replace(system, "frequency=\"1000\"", "frequency=\"" + std::to_string(hertz) + "\"");
    return system;
}

CortexLive::CortexLive(const std::string& controller, const std::string& items) {
    std::string system = mixerSystem();
    replace(system, "HoldAxisController\">", controller + "\">" + items);
    folder.write("mixer.xml", system);
    start();
}

void CortexLive::start() { agent.emplace(agentCommand((folder.path() / "mixer.xml").string())); }

}  // namespace cortex::test
