// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "text/output.hpp"

#include <functional>
#include <memory>

#include <CLI/CLI.hpp>

namespace cortex::explorer {

// Makes verbs below `app`, whose options live as long as the program runs. A verb that was chosen
// sets `run`; `json` is the flag of all verbs.
class Verbs {
public:
    Verbs(CLI::App& app, bool& json, std::function<Exit()>& run)
        : app_{app}, json_{json}, run_{run} {}

    template <class Options>
    CLI::App* add(const char* name, const char* description, const char* examples,
                  const std::shared_ptr<Options>& options, Exit (*verb)(const Options&)) {
        CLI::App* added = app_.add_subcommand(name, description);
        added->footer(examples);
        added->add_flag("--json", json_, "Print JSON, as described in docs/command-line.md");
        added->callback([&json = json_, &run = run_, options, verb] {
            run = [&json, options, verb] {
                options->json = json;
                return verb(*options);
            };
        });
        return added;
    }

private:
    CLI::App& app_;
    bool& json_;
    std::function<Exit()>& run_;
};

}  // namespace cortex::explorer
