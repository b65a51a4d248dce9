// SPDX-License-Identifier: Apache-2.0
#include "cli/live_agent.hpp"

#include "cli/json_schema.hpp"
#include "support/own_domain.hpp"

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::test {

using nlohmann::json;

const std::string domain = std::to_string(ownDomain());
const std::vector<std::string> network{"--domain", domain, "--interface", "127.0.0.1"};

std::vector<std::string> operator+(std::vector<std::string> left,
                                   const std::vector<std::string>& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

Outcome live(const std::vector<std::string>& arguments) {
    return cortex(arguments + network +
                  std::vector<std::string>{"--timeout", std::to_string(patience.count())});
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

Background::Background(std::vector<std::string> command) : child_{fork()} {
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ > 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int null = open("/dev/null", O_RDWR);
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, file);
    setenv("CORTEX_PATH", CORTEX_SOURCE_DIR "/ontology", 1);
    std::vector<char*> pointers;
    for (std::string& each : command) pointers.push_back(each.data());
    pointers.push_back(nullptr);
    execv(pointers.front(), pointers.data());
    _exit(127);
}

Background::~Background() { end(SIGTERM); }

void Background::end(int signal) {
    if (child_ == 0) return;
    kill(child_, signal);
    kill(child_, SIGCONT);  // what was stopped ends, too
    waitpid(child_, nullptr, 0);
    child_ = 0;
}

void Background::send(int signal) {
    if (child_ != 0) kill(child_, signal);
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

CortexLive::CortexLive(const std::string& controller) {
    std::string system = mixerSystem();
    replace(system, "HoldAxisController", controller);
    folder.write("mixer.xml", system);
    start();
}

void CortexLive::start() { agent.emplace(agentCommand((folder.path() / "mixer.xml").string())); }

}  // namespace cortex::test
