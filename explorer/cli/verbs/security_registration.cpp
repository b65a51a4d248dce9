// SPDX-License-Identifier: Apache-2.0
#include "verbs/security_registration.hpp"

#include "cortex/comms/network_options.hpp"

#include "verbs/security_verb.hpp"
#include "verbs/verb_registration.hpp"

#include <memory>

namespace cortex::cli {
namespace {

void addDays(CLI::App& verb, SecurityOptions& options, const char* description) {
    verb.add_option("--days", options.days, description)
        ->type_name("N")
        ->check(CLI::Range(1, 36500));
}

void addAuthority(Verbs& verbs) {
    const auto options = std::make_shared<SecurityOptions>();
    CLI::App* verb =
        verbs.add("create-authority", "Make the keys with which the folders of agents are made",
                  R"(Once for a plant. Nothing is ever overwritten.
Example:
  cortex security create-authority plant-authority)",
                  options, makeAuthority);
    verb->add_option("FOLDER", options->authority, "Folder to make; 'authority' if not given")
        ->type_name("");
    addDays(*verb, *options, "How long it is valid; 3650 if not given");
}

void addAgent(Verbs& verbs) {
    const auto options = std::make_shared<SecurityOptions>();
    CLI::App* verb = verbs.add(
        "create-agent", "Make the folder of keys and rights of one agent or tool",
        R"(An agent's NAME is that of its <cluster>; a tool may have any. Nothing is ever overwritten.
Without --read-only and --may-command it may command everything. Without --owns it owns the paths
that it has before any other agent.
Examples:
  cortex security create-agent robot --owns /arm /gripper
  cortex security create-agent station1 --may-command /cell /belt
  cortex security create-agent display --read-only --out display-2027)",
        options, makeAgent);
    verb->add_option("NAME", options->agent, "Name of the agent or tool")
        ->required()
        ->type_name("");
    verb->add_option("--authority", options->authority,
                     "Folder of the authority; 'authority' if not given")
        ->type_name("FOLDER");
    verb->add_option("--out", options->folder, "Folder to make; NAME if not given")
        ->type_name("FOLDER");
    CLI::Option* readOnly =
        verb->add_flag("--read-only", options->readOnly, "It may look and command nothing");
    verb->add_option("--may-command", options->mayCommand,
                     "Paths that it may command, with all below")
        ->type_name("PREFIX")
        ->excludes(readOnly);
    verb->add_option("--owns", options->owns,
                     "Paths that are its own, with all below: it is linked and commanded there "
                     "alone, and no other agent takes them from it")
        ->type_name("PREFIX");
    verb->add_option("--domain", options->domains, "Domains that it may join; all if not given")
        ->type_name("N")
        ->check(CLI::Range(0, comms::lastDomain));
    addDays(*verb, *options, "How long it is valid; 365 if not given");
}

void addShow(Verbs& verbs) {
    const auto options = std::make_shared<SecurityOptions>();
    verbs
        .add("show", "Check the folder of an agent, and show whose it is and what it may",
             R"(It is checked as an agent does at its start. Exit code 0: it can be used, 1: not.
Example:
  cortex security show station1)",
             options, showSecurity)
        ->add_option("FOLDER", options->folder, "Folder of an agent")
        ->required()
        ->type_name("");
}

}  // namespace

void addSecurityVerbs(CLI::App& app, bool& json, std::function<Exit()>& run) {
    CLI::App* security =
        app.add_subcommand("security", "Make the keys of agents, and say what each may command");
    security->require_subcommand(1);
    security->footer("How security works: docs/security.md");
    Verbs verbs{*security, json, run};
    addAuthority(verbs);
    addAgent(verbs);
    addShow(verbs);
}

}  // namespace cortex::cli
