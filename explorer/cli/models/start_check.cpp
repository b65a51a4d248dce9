// SPDX-License-Identifier: Apache-2.0
#include "models/start_check.hpp"

#include "cortex/core/system_findings.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::cli {
namespace {

namespace fs = std::filesystem;

struct Ended {
    std::string output;
    int status = 0;       // as waitpid() gives it
    std::string failure;  // why it did not run at all
};

std::string readAll(int descriptor) {
    std::string text;
    std::array<char, 4096> part{};
    for (;;) {
        const ssize_t length = ::read(descriptor, part.data(), part.size());
        if (length < 0 && errno == EINTR) continue;
        if (length <= 0) return text;
        text.append(part.data(), static_cast<std::size_t>(length));
    }
}

// In the new process, which ends with us: a plug-in may never return.
[[noreturn]] void become(char* const* arguments, int output, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(EXIT_FAILURE);
    dup2(output, STDOUT_FILENO);
    execv(arguments[0], arguments);
    _exit(errno == ENOENT ? 127 : 126);  // as a shell says it
}

// Its standard error is ours.
Ended run(std::vector<std::string> words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return {"", 0, std::strerror(errno)};
    std::vector<char*> arguments;
    for (std::string& each : words) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    const pid_t parent = getpid(), child = fork();
    if (child == 0) become(arguments.data(), ends[1], parent);
    Ended ended;
    if (child < 0) ended.failure = std::strerror(errno);
    close(ends[1]);
    if (child > 0) {
        ended.output = readAll(ends[0]);
        while (waitpid(child, &ended.status, 0) < 0 && errno == EINTR) {
        }
    }
    close(ends[0]);
    return ended;
}

fs::path agentProgram() {
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path{} : self.parent_path() / "cortex-agent";
}

// The system that an agent would be given; empty: it reads others than those that were named.
fs::path systemAlone(const Paths& files) {
    const auto system = files.size() == 1 ? files.begin() : std::ranges::find_if(files, isSystem);
    const Paths read = readTypes(std::array{*system}).files;
    const bool readsAll = std::ranges::all_of(files, [&](const fs::path& file) {
        return std::ranges::any_of(read, [&](const fs::path& each) {
            std::error_code ignored;
            return fs::equivalent(each, file, ignored);
        });
    });
    return readsAll ? *system : fs::path{};
}

std::string howItEnded(const Ended& ended) {
    if (!ended.failure.empty()) return "could not be run: " + ended.failure;
    if (WIFSIGNALED(ended.status))
        return "ended by signal " + std::to_string(WTERMSIG(ended.status)) + " (" +
               strsignal(WTERMSIG(ended.status)) + ")";
    return "ended with exit code " + std::to_string(WEXITSTATUS(ended.status));
}

}  // namespace

bool checkStart(Model& model, const Paths& files, const Paths& plugins) {
    const Place place = model.tree->description().place;
    const auto note = [&](const std::string& message, const std::string& remedy) {
        model.report.add({Severity::Info, "", finding::startUnchecked, place, message, remedy});
        return false;
    };
    const fs::path program = agentProgram(), system = systemAlone(files);
    std::error_code ignored;
    if (!fs::exists(program, ignored))
        return note(
            "only the model was checked: cortex-agent, which has the classes of active "
            "types, is not beside this program",
            "install it for what a start would find");
    if (system.empty())
        return note(
            "only the model was checked: an agent reads this file alone, and this one does "
            "not name all the others",
            "name them in it: <ontology file=\"…\"/> or <morphology file=\"…\"/>");
    std::vector<std::string> words{program.string(), system.string(), "--validate"};
    for (const fs::path& each : plugins) {
        words.emplace_back("--plugin");
        words.push_back(each.string());
    }
    std::string command = program.filename().string();
    for (std::size_t i = 1; i < words.size(); ++i) command += " " + words[i];
    const Ended ended = run(words);
    try {
        // What the model alone tells stands in both, and is told once by joinReports().
        model.report.append(findingsOf(Json::parse(ended.output).at("findings")));
        return true;
    } catch (const Json::exception&) {
        model.report.error("", finding::startRefused, place,
                           program.string() + " " + howItEnded(ended) + " in checking its start",
                           command + " says the same");
        return false;
    }
}

}  // namespace cortex::cli
