// SPDX-License-Identifier: Apache-2.0
#include "verbs/program.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"

#include "verbs/file_registration.hpp"
#include "verbs/live_registration.hpp"
#include "verbs/live_verbs.hpp"
#include "verbs/security_registration.hpp"
#include "verbs/shell_verb.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>

namespace cortex::cli {
namespace {

std::string nearestOrAll(const std::string& wrong, const std::vector<std::string>& names) {
    const std::string nearest = nearestNames(wrong, names);
    return nearest.empty() ? "there are " + joined(names) : nearest;
}

// CLI11 calls an unknown verb an unexpected argument. Empty: it is one.
std::string wrongVerb(const CLI::App& app, const std::string& wrong) {
    if (wrong.starts_with('-')) return {};
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands(nullptr)) names.push_back(verb->get_name());
    if (std::ranges::count(names, wrong) > 0) return {};
    return "there is no verb '" + wrong + "'; " + nearestOrAll(wrong, names);
}

std::string wrongOption(const CLI::App& app, const std::string& argument) {
    const std::string wrong = argument.substr(0, argument.find('='));
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    const bool takesFiles =
        app.get_option_no_throw("FILE") != nullptr || app.get_option_no_throw("OURS") != nullptr;
    const bool file = takesFiles && (wrong == "-f" || wrong == "--file");
    const bool early = !app.get_subcommands().empty();
    return "there is no option '" + wrong + "'" + (early ? " before the verb" : "") +
           (file ? " here: name the files without it" : "; " + nearestOrAll(wrong, names)) +
           (early ? "; those of a verb stand after it" : "");
}

// What is wrong, better than CLI11 says it: with the nearest option, or where a file belongs.
std::string wrongUsage(const CLI::App& app, const CLI::ParseError& error) {
    for (const std::string& argument : app.remaining()) {
        if (argument.starts_with('-') && argument != "--") return wrongOption(app, argument);
    }
    if (!app.get_subcommands().empty()) return wrongUsage(*app.get_subcommands().front(), error);
    const std::vector<std::string> extra = app.remaining();
    if (app.get_parent() != nullptr && app.get_require_subcommand_min() > 0) {
        return wrongVerb(app, extra.empty() ? "" : extra.front());
    }
    const CLI::Option* path = app.get_option_no_throw("PATH");
    const bool isRequired = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (isRequired && app.get_name() == "set" && path != nullptr && path->count() == 1) {
        return howToSet(path->results().front(), {});
    }
    if (extra.empty() || dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) {
        return error.what();
    }
    const bool files =
        app.get_option_no_throw("--file") != nullptr && std::ranges::all_of(extra, looksLikeFile);
    return "'" + joined(extra, " ") + "' was not expected" +
           (files ? "; did you mean --file " + joined(extra, " ") + "?" : "");
}

// An error that lists several things has an indented line for each.
std::string linesOf(std::string_view text) {
    constexpr std::string_view indented = "\n  ";
    const std::size_t end = text.find(indented);
    if (end == std::string_view::npos) return printable(text);
    return printable(text.substr(0, end)) + std::string{indented} +
           linesOf(text.substr(end + indented.size()));
}

void printFailure(const Failure& failure, bool json) {
    if (json) {
        print({{"error", failure.what()}, {"findings", findingsJson(failure.report())}});
        return;
    }
    printFindings(failure.report(), Stream::Errors);
    const bool said = failure.code() == NotFound && !failure.report().ok();  // by the findings
    if (!said) std::cerr << "cortex: " << linesOf(failure.what()) << '\n';
}

}  // namespace

Program::Program(std::shared_ptr<Session> session, const AddVerbs& addMore)
    : app_{"cortex: look at, check and make models of control systems", "cortex"} {
    app_.footer(
        R"(Exit codes: 0 yes, 1 no (findings, a difference, refused), 2 wrong usage, 3 not found, no answer,
4 still running.
Help on a verb: cortex VERB --help
Files are looked for as given, then in $CORTEX_PATH, then in the installed share/cortex.)");
    app_.set_version_flag("--version", "cortex " CORTEX_VERSION, "Print the version and end");
    app_.require_subcommand(1);
    app_.get_formatter()->column_width(28);
    Verbs verbs{app_, json_, run_, std::move(session)};
    addFileVerbs(verbs);
    addLiveVerbs(verbs);
    addSecurityVerbs(app_, json_, run_);
    if (!verbs.session()) addShell(verbs);
    if (addMore) addMore(verbs);
}

Exit Program::parse(const std::vector<std::string>& words) {
    std::string wrong = words.empty() ? "" : wrongVerb(app_, words.front());
    try {
        if (wrong.empty()) {
            app_.parse(std::vector<std::string>{words.rbegin(), words.rend()});
            return Yes;
        }
    } catch (const CLI::Success& asked) {  // help, version
        app_.exit(asked);
        return Yes;
    } catch (const CLI::ParseError& error) {
        if (!words.empty()) wrong = wrongUsage(app_, error);
    }
    if (wrong.empty()) {
        std::cerr << app_.help();
        return Usage;
    }
    const auto verbs = app_.get_subcommands();
    std::cerr << "cortex: " << printable(wrong) << "\nhelp: cortex "
              << (verbs.empty() ? "" : verbs.front()->get_name() + " ") << "--help\n";
    return Usage;
}

Exit Program::run(const std::vector<std::string>& words) {
    const Exit parsed = parse(words);
    if (!run_) return parsed;
    Exit result = Yes;
    try {
        result = run_();
    } catch (const Failure& failure) {
        printFailure(failure, json_);
        result = failure.code();
    } catch (const std::exception& error) {
        printFailure(Failure{No, error.what()}, json_);
        result = No;
    }
    if (!std::cout.flush()) {
        std::cerr << "cortex: cannot write to standard output\n";
        return No;
    }
    return result;
}

}  // namespace cortex::cli
