// SPDX-License-Identifier: Apache-2.0
#include "verbs/shell_verb.hpp"

#include "cortex/core/error.hpp"

#include "common/person_name.hpp"
#include "text/interrupts.hpp"
#include "text/line_editor.hpp"
#include "text/terminal.hpp"
#include "text/words.hpp"
#include "verbs/live_registration.hpp"
#include "verbs/program.hpp"
#include "verbs/shell_commands.hpp"
#include "verbs/shell_completion.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <unistd.h>

namespace cortex::cli {
namespace {

std::string historyFile() {
    if (const char* named = std::getenv("CORTEX_HISTORY")) return named;
    const char* home = std::getenv("HOME");
    return home == nullptr ? "" : std::string{home} + "/.cortex_history";
}

class Shell {
public:
    Shell(const ShellOptions& options, std::shared_ptr<Session> session)
        : options_{options}, session_{std::move(session)} {}

    Exit runLines(std::istream& lines, const std::string& name) {
        Exit first = Yes;
        std::string line;
        for (int number = 1; !leaves_ && std::getline(lines, line); ++number) {
            const Exit exit = run(line);
            throwIfInterrupted();
            std::cout.flush();
            printNews();
            if (exit == Yes) continue;
            if (first == Yes) first = exit;
            std::cerr << "cortex: " << printable(name) << ':' << number << ": '" << printable(line)
                      << "' ended with exit code " << exit
                      << (options_.keepGoing ? "" : "; what follows was not run (--keep-going)")
                      << std::endl;
            if (!options_.keepGoing) break;
        }
        throwIfInterrupted();
        return first;
    }

    Exit runPrompt() {
        LineEditor editor{{[this] { return promptText(); },
                           [this](const std::string& before) { return complete(before); },
                           [this] { return newsText(); }},
                          historyFile()};
        std::cout << "cortex shell: you are "
                  << common::whoText(session_->mirror().name(), session_->person()) << " in domain "
                  << session_->domain() << "; 'help' lists the verbs, Ctrl-D leaves" << std::endl;
        for (std::string line; !leaves_;) {
            leaveIfAsked();
            Interrupts::forget();
            printNews();
            const auto ended = editor.read(line);
            if (ended == LineEditor::Ended::ByEnd) break;
            if (ended == LineEditor::Ended::ByReturn) run(line);
        }
        leaveIfAsked();
        return Yes;
    }

private:
    Exit run(const std::string& line) {
        auto words = splitWords(line);
        if (!words) {
            std::cerr << "cortex: a quote does not end" << std::endl;
            return Usage;
        }
        if (!words->empty() && words->front() == "cortex") words->erase(words->begin());
        if (words->empty()) return Yes;
        Program program{session_, [this](Verbs& verbs) { addShellCommands(verbs, leaves_); }};
        try {
            return program.run(*words);
        } catch (const Interrupted& interrupted) {
            const std::string& remark = interrupted.remark;
            std::cout.flush();
            std::cerr << "cortex: interrupted" << (remark.empty() ? "" : "; " + remark)
                      << std::endl;
            return No;
        }
    }
    // Ctrl-C ends a verb; other signals end the shell.
    static void leaveIfAsked() {
        if (Interrupts::signal() != SIGINT) throwIfInterrupted();
    }
    std::vector<std::string> complete(const std::string& before) {
        const Program program{session_, [this](Verbs& verbs) { addShellCommands(verbs, leaves_); }};
        return completionsOf(before, program.verbs(), *session_);
    }
    std::string newsText() {
        std::vector<std::string> news;
        for (const std::string& each : session_->leases().news()) {
            news.push_back("cortex: " + common::shownName(each));
        }
        for (const std::string& each : session_->askNews().news(session_->leases())) {
            news.push_back("cortex: " + printable(each));
        }
        return joined(news, "\n");
    }
    void printNews() {
        const std::string news = newsText();
        if (!news.empty()) std::cerr << news << std::endl;
    }
    std::string promptText() const {
        const auto held = session_->leases().held();
        if (held.empty()) return "cortex> ";
        const std::string more = held.size() > 1 ? " +" + std::to_string(held.size() - 1) : "";
        return "cortex [" + held.front().prefix + more + "]> ";
    }

    const ShellOptions& options_;
    std::shared_ptr<Session> session_;
    bool leaves_ = false;
};

std::string aPersonsName(const std::string& name) {
    try {
        common::personName(name);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

// Only this thread gets signals: those of the session are made while they are blocked.
std::shared_ptr<Session> makeQuietSession(const NetworkArguments& network) {
    const Signals blocked;
    return makeSession(network);
}

}  // namespace

Exit runShell(const ShellOptions& options) {
    std::ifstream file;
    if (!options.file.empty()) {
        file.open(options.file);
        if (!file || std::filesystem::is_directory(options.file))
            throw Failure{NotFound, "there is no file '" + options.file + "' to run"};
    }
    const Interrupts interrupts;
    const std::shared_ptr<Session> session = makeQuietSession(options.network);
    session->introduce(common::personName(options.name));
    session->acceptOffers();
    Shell shell{options, session};
    if (!options.file.empty()) return shell.runLines(file, options.file);
    if (isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1) return shell.runPrompt();
    return shell.runLines(std::cin, "<stdin>");
}

void addShell(Verbs& verbs) {
    const auto options = std::make_shared<ShellOptions>();
    CLI::App* verb = verbs.addPlain(
        "shell", "Run verbs in one process, which can hold control of parts of the plant",
        R"(Each line is a verb as it stands behind 'cortex'. On a terminal with history and completion (Tab);
Ctrl-C ends a verb, Ctrl-D the shell. Of a file or a pipe the first line that fails ends it, with the
exit code of that line. In it, 'take', 'release', 'handover' and 'ask' say who may command:
docs/leases.md.
Examples:
  cortex shell --name alice
  cortex shell morning.txt
  echo "list /arm" | cortex shell)",
        [options] { return runShell(*options); });
    verb->add_option("FILE", options->file, "Lines to run; those typed or piped if not given")
        ->type_name("");
    verb->add_flag("--keep-going", options->keepGoing, "Go on after a line that fails");
    verb->add_option("--name", options->name,
                     "Who you are, as others see it; USER@HOST if not given; no right follows")
        ->type_name("NAME")
        ->check(aPersonsName);
    addNetwork(*verb, options->network, nullptr);
}

}  // namespace cortex::cli
