// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/session.hpp"
#include "text/output.hpp"

#include <functional>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

namespace cortex::cli {

// Makes verbs below `app`, whose options live as long as the program runs. A verb that was chosen
// sets `run`; `json` is the flag of all verbs.
class Verbs {
public:
    // `session`: that of the shell in which the verbs are; null outside of a shell.
    Verbs(CLI::App& app, bool& json, std::function<Exit()>& run,
          std::shared_ptr<Session> session = {})
        : app_{app}, json_{json}, run_{run}, session_{std::move(session)} {}

    const CLI::App& app() const { return app_; }
    const std::shared_ptr<Session>& session() const { return session_; }

    template <class Options>
    CLI::App* add(const char* name, const char* description, const char* examples,
                  const std::shared_ptr<Options>& options, Exit (*verb)(const Options&)) {
        CLI::App* added = addPlain(name, description, examples, [&json = json_, options, verb] {
            options->json = json;
            return verb(*options);
        });
        added->add_flag("--json", json_, "Print JSON, as described in docs/command-line.md");
        return added;
    }
    // Without --json.
    CLI::App* addPlain(const char* name, const char* description, const char* examples,
                       std::function<Exit()> verb) {
        CLI::App* added = app_.add_subcommand(name, description);
        added->footer(examples);
        added->callback([&run = run_, verb = std::move(verb)] { run = verb; });
        return added;
    }

private:
    CLI::App& app_;
    bool& json_;
    std::function<Exit()>& run_;
    std::shared_ptr<Session> session_;
};

}  // namespace cortex::cli
