// SPDX-License-Identifier: Apache-2.0
#include "cli/cortex_process.hpp"

#include "support/waiting.hpp"

#include <cstdio>
#include <cstdlib>
#include <future>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::test {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, CloseFile>;

std::string contentOf(std::FILE* file) {
    std::string content;
    std::rewind(file);
    char buffer[4096];
    for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
        content.append(buffer, count);
    }
    return content;
}

std::string inOneLine(const std::vector<std::string>& command) {
    std::string text;
    for (const std::string& each : command) text += (text.empty() ? "" : " ") + each;
    return text;
}

}  // namespace

Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::map<std::string, std::string>& environment,
                   const std::string& folder) {
    std::vector<std::string> copies{program};
    copies.insert(copies.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& each : copies) pointers.push_back(each.data());
    pointers.push_back(nullptr);
    const TemporaryFile output{std::tmpfile()}, errors{std::tmpfile()};
    if (!output || !errors) throw std::runtime_error("no temporary file");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) {
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        dup2(fileno(output.get()), STDOUT_FILENO);
        dup2(fileno(errors.get()), STDERR_FILENO);
        setenv("CORTEX_PATH", CORTEX_SOURCE_DIR "/ontology", 1);
        for (const auto& [name, value] : environment) {
            if (value.empty())
                unsetenv(name.c_str());
            else
                setenv(name.c_str(), value.c_str(), 1);
        }
        if (chdir(folder.c_str()) == 0) execvp(program.c_str(), pointers.data());
        _exit(127);
    }
    const auto status = statusOf(child);
    Outcome outcome{-1, contentOf(output.get()), contentOf(errors.get())};
    if (status && WIFEXITED(*status)) outcome.exit = WEXITSTATUS(*status);
    if (!status) {
        outcome.errors += "killed, as it hung for " + std::to_string(longestRun.count()) + " s\n";
        ADD_FAILURE() << inOneLine(copies) << " hung and was killed; it printed: " << outcome.output
                      << outcome.errors;
    }
    return outcome;
}

Outcome cortex(const std::vector<std::string>& arguments,
               const std::map<std::string, std::string>& environment, const std::string& folder) {
    return runProgram(CORTEX_BINARY_DIR "/bin/cortex", arguments, environment, folder);
}

std::vector<Outcome> cortexAtOnce(const std::vector<std::vector<std::string>>& commands,
                                  const std::map<std::string, std::string>& environment) {
    std::vector<std::future<Outcome>> running;
    for (const auto& each : commands) {
        running.push_back(
            std::async(std::launch::async, [&] { return cortex(each, environment); }));
    }
    std::vector<Outcome> outcomes;
    for (auto& each : running) outcomes.push_back(each.get());
    return outcomes;
}

}  // namespace cortex::test
