// SPDX-License-Identifier: Apache-2.0
#include "verbs/asking_commands.hpp"

#include "common/leases_text.hpp"
#include "common/person_name.hpp"
#include "live/asking.hpp"
#include "verbs/live_registration.hpp"

#include <iostream>

namespace cortex::cli {
namespace {

struct AskOptions {
    NetworkArguments network;
    std::string of;  // the prefix, or who asks
};

Exit ask(const AskOptions& options) {
    Live live{options.network};
    for (const std::string& each : askForControl(live, options.of)) {
        std::cout << printable(each) << '\n';
    }
    return Yes;
}

Exit withdraw(const AskOptions& options) {
    Live live{options.network};
    const std::string prefix = withdrawAsk(live);
    std::cout << "you no longer ask for " << prefix << '\n';
    return Yes;
}

Exit grant(const AskOptions& options) {
    Live live{options.network};
    const Asked asked = askedBy(live, options.of);
    grantControl(live, asked);
    std::cout << common::leasesText(asked.gives) << " was handed over to "
              << common::whoText(asked.tool, asked.person) << '\n';
    return Yes;
}

Exit refuse(const AskOptions& options) {
    Live live{options.network};
    const Asked asked = askedBy(live, options.of);
    refuseControl(live, asked);
    std::cout << asked.prefix << " was refused to " << common::whoText(asked.tool, asked.person)
              << '\n';
    return Yes;
}

CLI::App* addVerb(Verbs& verbs, const char* name, const char* description, const char* examples,
                  const std::shared_ptr<AskOptions>& options, Exit (*run)(const AskOptions&)) {
    CLI::App* verb =
        verbs.addPlain(name, description, examples, [options, run] { return run(*options); });
    addNetwork(*verb, options->network, verbs.session());
    return verb;
}

CLI::Option* addAnswer(Verbs& verbs, const char* name, const char* description,
                       const char* examples, Exit (*run)(const AskOptions&)) {
    const auto options = std::make_shared<AskOptions>();
    return addVerb(verbs, name, description, examples, options, run)
        ->add_option("NAME", options->of, "Whole name of the person or tool that asks")
        ->type_name("");
}

}  // namespace

void addAskingCommands(Verbs& verbs) {
    const auto asked = std::make_shared<AskOptions>();
    addVerb(verbs, "ask", "Ask those for control who hold a part of it",
            R"(The shell says what becomes of it. Nobody need answer; after two minutes it ends.
Example:
  ask /arm)",
            asked, ask)
        ->add_option("PREFIX", asked->of, "Path at and below which; / for all")
        ->required()
        ->type_name("");
    addVerb(verbs, "withdraw", "Ask no longer", "Example:\n  withdraw",
            std::make_shared<AskOptions>(), withdraw);
    // Whoever asks may be another one by the time that the line is read: so the name is required.
    addAnswer(verbs, "grant", "Hand over control to who asks for it",
              R"(It says what goes: who holds all of an agent cannot give a part.
Example:
  grant "alice of the night shift")",
              grant)
        ->required();
    addAnswer(verbs, "refuse", "Refuse control to who asks for it; without a name the only one",
              "Example:\n  refuse alice", refuse);
}

}  // namespace cortex::cli
