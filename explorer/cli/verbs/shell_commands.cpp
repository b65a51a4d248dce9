// SPDX-License-Identifier: Apache-2.0
#include "verbs/shell_commands.hpp"

#include "cortex/core/nearest_names.hpp"

#include "live/asking.hpp"
#include "live/control.hpp"
#include "live/people.hpp"
#include "verbs/asking_commands.hpp"
#include "verbs/live_registration.hpp"

#include <algorithm>
#include <iostream>

namespace cortex::cli {
namespace {

struct ControlOptions {
    NetworkArguments network;
    std::string prefix, to;
};

Exit take(const ControlOptions& options) {
    Live live{options.network};
    takeControl(live, options.prefix);
    std::cout << "you control " << options.prefix << " until you release it\n";
    return Yes;
}

Exit release(const ControlOptions& options) {
    Live live{options.network};
    releaseControl(live, options.prefix);
    std::cout << options.prefix << " is released\n";
    return Yes;
}

Exit handOver(const ControlOptions& options) {
    Live live{options.network};
    const std::string to = recipientOf(live, options.to);
    handOverControl(live, options.prefix, to);
    std::cout << options.prefix << " was handed over to " << whoIs(live, to)
              << ", who must renew it within 2 s; a shell does so by itself\n";
    return Yes;
}

CLI::App* addControl(Verbs& verbs, const char* name, const char* description, const char* examples,
                     const std::shared_ptr<ControlOptions>& options,
                     Exit (*run)(const ControlOptions&)) {
    CLI::App* verb =
        verbs.addPlain(name, description, examples, [options, run] { return run(*options); });
    verb->add_option("PREFIX", options->prefix, "Path at and below which; / for all")
        ->required()
        ->type_name("");
    addNetwork(*verb, options->network, verbs.session());
    return verb;
}

// "watch PATH[.ITEM]... [OPTIONS]"
std::string usageOf(const CLI::App& verb) {
    std::string usage = verb.get_name();
    bool options = false;
    for (const CLI::Option* each : verb.get_options()) {
        if (!each->get_positional()) {
            options = options || each->get_name() != "--help";
            continue;
        }
        const bool many = each->get_items_expected_max() > 1;
        const std::string word = each->get_name(true) + (many ? "..." : "");
        usage += each->get_required() ? " " + word : " [" + word + "]";
    }
    return usage + (options ? " [OPTIONS]" : "");
}

Exit printHelp(const CLI::App& app, const std::string& name) {
    if (name.empty()) {
        Columns columns{2};
        for (const CLI::App* each : app.get_subcommands(nullptr)) {
            columns.add({usageOf(*each), each->get_description()});
        }
        columns.print(std::cout);
        std::cout << "\n'help VERB' explains one with its options.\n";
        return Yes;
    }
    std::vector<std::string> names;
    for (const CLI::App* each : app.get_subcommands(nullptr)) {
        if (each->get_name() == name) {
            std::cout << each->help("cortex");
            return Yes;
        }
        names.push_back(each->get_name());
    }
    const std::string nearest = nearestNames(name, names);
    throw Failure{Usage, "there is no verb '" + name + "'; " +
                             (nearest.empty() ? "'help' lists all" : nearest)};
}

}  // namespace

void addShellCommands(Verbs& verbs, bool& leaves) {
    addControl(verbs, "take", "Take control (the lease) of a part of the plant, and keep it",
               R"(Only you may command it then, until you release it, hand it over or leave.
Example:
  take /arm)",
               std::make_shared<ControlOptions>(), take);
    addControl(verbs, "release", "Give control back", "Example:\n  release /arm",
               std::make_shared<ControlOptions>(), release);
    const auto to = std::make_shared<ControlOptions>();
    addControl(
        verbs, "handover", "Give control to another agent, tool or person",
        R"(A person is who uses one window or shell alone; 'people' shows their names. These keep what is handed
over to them; another tool must renew it.
Examples:
  handover /arm alice
  handover /arm cortex@desk.4711-5e1f0a)",
        to, handOver)
        ->add_option("TO", to->to, "Whole name of the agent, tool or person")
        ->required()
        ->type_name("");
    addAskingCommands(verbs);
    const auto name = std::make_shared<std::string>();
    verbs
        .addPlain("help", "List the verbs, or explain one", "Example:\n  help watch",
                  [&app = verbs.app(), name] { return printHelp(app, *name); })
        ->add_option("VERB", *name, "Verb to explain")
        ->type_name("");
    for (const char* each : {"quit", "exit"}) {
        verbs.addPlain(each, "Leave the shell, and release control", "", [&leaves] {
            leaves = true;
            return Yes;
        });
    }
}

}  // namespace cortex::cli
