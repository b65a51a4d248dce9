// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/session.hpp"
#include "text/output.hpp"
#include "verbs/verb_registration.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace cortex::cli {

// One command line: the verbs, and running the one that is named. Used once.
class Program {
public:
    using AddVerbs = std::function<void(Verbs&)>;

    // With a session it is a line in a shell; `addMore` adds verbs that exist only here.
    explicit Program(std::shared_ptr<Session> session = {}, const AddVerbs& addMore = {});

    const CLI::App& verbs() const { return app_; }
    // Prints what the verb says, and what is wrong; throws Interrupted.
    Exit run(const std::vector<std::string>& words);

private:
    Exit parse(const std::vector<std::string>& words);

    CLI::App app_;
    bool json_ = false;
    std::function<Exit()> run_;  // the verb that was chosen
};

}  // namespace cortex::cli
