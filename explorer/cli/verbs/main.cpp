// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"

#include "verbs/live_registration.hpp"
#include "verbs/security_registration.hpp"
#include "verbs/verbs.hpp"

#include <algorithm>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>

namespace cortex::explorer {
namespace {

constexpr const char* jsonHelp = "Print JSON, as described in docs/command-line.md";

// What is parsed into, and the verb that was chosen.
struct VerbArguments {
    ValidateOptions validate;
    DiffOptions diff;
    TypesOptions types;
    std::string type;
    GraphOptions graph;
    NewTypeOptions newType;
    NewSystemOptions newSystem;
    bool json = false;
    std::function<Exit()> run;
};

CLI::App* addVerb(CLI::App& app, VerbArguments& arguments, const char* name,
                  const char* description, const char* examples) {
    CLI::App* verb = app.add_subcommand(name, description);
    verb->footer(examples);
    verb->add_flag("--json", arguments.json, jsonHelp);
    return verb;
}

CLI::Option* addFiles(CLI::App& verb, Paths& files) {
    return verb
        .add_option("-f,--file", files,
                    "Model files; each may include others, so one is often enough")
        ->type_name("FILE");
}

void addOutput(CLI::App& verb, NewFileOptions& options, const char* description) {
    verb.add_option("-o,--output", options.output, description)->type_name("FILE");
    verb.add_flag("--force", options.force, "Replace a file that exists");
}

// Files or, without them, a network.
void addSource(CLI::App& verb, Paths& files, NetworkArguments& network) {
    CLI::Option* file = addFiles(verb, files);
    addNetwork(verb, network);
    for (const char* each :
         {"--domain", "--interface", "--peer", "--discovery-server", "--timeout"}) {
        verb.get_option(each)->excludes(file);
    }
}

void refuseFileAsType(const std::string& type) {
    if (!looksLikeFile(type)) return;
    throw Failure{Usage, "'" + type + "' is a file, not a type; did you mean --file " + type + "?"};
}

void addValidate(CLI::App& app, VerbArguments& arguments) {
    CLI::App* verb = addVerb(
        app, arguments, "validate", "Check model files as an agent does at its start",
        R"(Every finding is printed: what is wrong where, and what to write instead. Exit code 0: valid,
1: not, 3: a file was not found.
Examples:
  cortex validate lbr_teleop.xml           a system, with the types and rules that it names
  cortex validate robotics-morphology.xml  types and rules alone)");
    verb->add_option("FILE", arguments.validate.files,
                     "System, ontology or morphology files; together they are one model")
        ->required()
        ->type_name("");
    verb->callback([&] {
        arguments.run = [&] {
            arguments.validate.json = arguments.json;
            return validateFiles(arguments.validate);
        };
    });
}

void addDiff(CLI::App& app, VerbArguments& arguments) {
    CLI::App* verb = addVerb(
        app, arguments, "diff", "Compare the types and rules of two models",
        R"(A contradiction keeps two agents from linking simplexes of that type, a difference is listed and
linked all the same; types that only one model has are no disagreement. Exit code 0: none, 1: some.
Example:
  cortex diff old/robotics-morphology.xml robotics-morphology.xml)");
    verb->add_option("OURS", arguments.diff.ours, "First model")->required()->type_name("FILE");
    verb->add_option("THEIRS", arguments.diff.theirs, "Second model")
        ->required()
        ->type_name("FILE");
    verb->callback([&] {
        arguments.run = [&] {
            arguments.diff.json = arguments.json;
            return diffModels(arguments.diff);
        };
    });
}

void addTypes(CLI::App& app, VerbArguments& arguments) {
    CLI::App* verb =
        addVerb(app, arguments, "types", "Show the tree of types, or everything about one",
                R"(Examples:
  cortex types                                         those of all agents on the network
  cortex types --file robotics-morphology.xml          the tree: who extends whom
  cortex types KukaLbr --file robotics-morphology.xml  its data, commands and relationships, own and
                                                       inherited, and its hash)");
    CLI::Option* type = verb->add_option("NAME", arguments.type, "Name of a type")->type_name("");
    addSource(*verb, arguments.types.files, arguments.types.network);
    verb->callback([&arguments, type] {
        arguments.run = [&arguments, named = type->count() > 0] {
            arguments.types.json = arguments.json;
            if (named) arguments.types.type = arguments.type;
            if (named && arguments.types.files.empty()) refuseFileAsType(arguments.type);
            return showTypes(arguments.types);
        };
    });
}

void addGraph(CLI::App& app, VerbArguments& arguments) {
    CLI::App* verb =
        addVerb(app, arguments, "graph", "Show relationships and the order of execution",
                R"(Examples:
  cortex graph                                         all agents on the network
  cortex graph --file lbr_teleop.xml
  cortex graph --dot --file lbr_teleop.xml | dot -Tsvg -o lbr_teleop.svg)");
    CLI::Option* dot =
        verb->add_flag("--dot", arguments.graph.dot, "Print a graph in the language of Graphviz");
    dot->excludes(verb->get_option("--json"));
    addSource(*verb, arguments.graph.files, arguments.graph.network);
    verb->callback([&] {
        arguments.run = [&] {
            arguments.graph.json = arguments.json;
            return showGraph(arguments.graph);
        };
    });
}

void addNewType(CLI::App& app, VerbArguments& arguments) {
    CLI::App* verb = addVerb(
        app, arguments, "new-type", "Make a commented skeleton of a type and its rules",
        R"(Two files: the ontology says what the type is, the morphology how it is joined to others.
Examples:
  cortex new-type Pump --extends Device                  print both
  cortex new-type Pump --extends Device -o pump.xml      write pump.xml and pump-morphology.xml
  cortex new-type Pump --extends Device Activity         extend two types)");
    NewTypeOptions& options = arguments.newType;
    verb->add_option("NAME", options.name, "Name of the new type")->required()->type_name("");
    verb->add_option("-e,--extends", options.parents, "Types that it extends")
        ->required()
        ->delimiter(',')
        ->type_name("TYPE");
    options.file = "robotics-morphology.xml";
    verb->add_option("-f,--file", options.file,
                     "Model that has these types; robotics-morphology.xml if not given")
        ->type_name("FILE");
    addOutput(*verb, options, "Ontology file to write; the morphology is written beside it");
    verb->callback([&] {
        arguments.run = [&] {
            arguments.newType.json = arguments.json;
            return newType(arguments.newType);
        };
    });
}

void addNewSystem(CLI::App& app, VerbArguments& arguments) {
    CLI::App* verb =
        addVerb(app, arguments, "new-system", "Make a commented skeleton of a system",
                R"(It is a small system that runs: one simulated axis, held where it is.
Examples:
  cortex new-system                          print it
  cortex new-system mixer -o mixer.xml       write it; then: cortex-agent mixer.xml --startup)");
    NewSystemOptions& options = arguments.newSystem;
    options.name = "plant";
    verb->add_option("NAME", options.name, "Name of the system and its agent; plant if not given")
        ->type_name("");
    addOutput(*verb, options, "File to write");
    verb->callback([&] {
        arguments.run = [&] {
            arguments.newSystem.json = arguments.json;
            return newSystem(arguments.newSystem);
        };
    });
}

void addVerbs(CLI::App& app, VerbArguments& arguments) {
    app.footer(
        R"(Exit codes: 0 yes, 1 no (findings, a difference, refused), 2 wrong usage, 3 not found, no answer.
Help on a verb: cortex VERB --help
Files are looked for as given, then in $CORTEX_PATH, then in the installed share/cortex.)");
    app.set_version_flag("--version", "cortex " CORTEX_VERSION, "Print the version and end");
    app.require_subcommand(1);
    app.get_formatter()->column_width(28);
    addValidate(app, arguments);
    addDiff(app, arguments);
    addTypes(app, arguments);
    addGraph(app, arguments);
    addNewType(app, arguments);
    addNewSystem(app, arguments);
    addLiveVerbs(app, arguments.json, arguments.run);
    addSecurityVerbs(app, arguments.json, arguments.run);
}

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
    if (extra.empty() || dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) {
        return error.what();
    }
    const bool files =
        app.get_option_no_throw("--file") != nullptr && std::ranges::all_of(extra, looksLikeFile);
    return "'" + joined(extra, " ") + "' was not expected" +
           (files ? "; did you mean --file " + joined(extra, " ") + "?" : "");
}

Exit parse(CLI::App& app, int count, char** values) {
    std::string wrong = count > 1 ? wrongVerb(app, values[1]) : "";
    try {
        if (wrong.empty()) {
            app.parse(count, values);
            return Yes;
        }
    } catch (const CLI::Success& asked) {  // help, version
        app.exit(asked);
        return Yes;
    } catch (const CLI::ParseError& error) {
        if (count > 1) wrong = wrongUsage(app, error);
    }
    if (wrong.empty()) {
        std::cerr << app.help();
        return Usage;
    }
    const auto verbs = app.get_subcommands();
    std::cerr << "cortex: " << printable(wrong) << "\nhelp: cortex "
              << (verbs.empty() ? "" : verbs.front()->get_name() + " ") << "--help\n";
    return Usage;
}

void printFailure(const Failure& failure, bool json) {
    if (json) {
        print({{"error", failure.what()}, {"findings", findingsJson(failure.report())}});
        return;
    }
    printFindings(failure.report(), Stream::Errors);
    const bool said = failure.code() == NotFound && !failure.report().ok();  // by the findings
    if (!said) std::cerr << "cortex: " << printable(failure.what()) << '\n';
}

int runProgram(int count, char** values) {
    VerbArguments arguments;
    CLI::App app{"cortex: look at, check and make models of control systems", "cortex"};
    addVerbs(app, arguments);
    const Exit parsed = parse(app, count, values);
    if (!arguments.run) return parsed;
    Exit result = Yes;
    try {
        result = arguments.run();
    } catch (const Failure& failure) {
        printFailure(failure, arguments.json);
        result = failure.code();
    } catch (const std::exception& error) {
        printFailure(Failure{No, error.what()}, arguments.json);
        result = No;
    }
    if (!std::cout.flush()) {
        std::cerr << "cortex: cannot write to standard output\n";
        return No;
    }
    return result;
}

}  // namespace
}  // namespace cortex::explorer

int main(int count, char** values) { return cortex::explorer::runProgram(count, values); }
