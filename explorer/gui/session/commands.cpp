// SPDX-License-Identifier: Apache-2.0
#include "session/commands.hpp"

#include <utility>

namespace cortex::explorer {

void Commands::send(const std::string& path, const std::string& command,
                    comms::Mirror::Arguments arguments, std::chrono::milliseconds limit,
                    QObject* asker, Done done) {
    const std::uint64_t number = session_.send(path, command, std::move(arguments), limit);
    asked_.emplace(number, Asked{asker, std::move(done)});
}

void Commands::deliver(const std::vector<CommandOutcome>& outcomes) {
    for (const CommandOutcome& each : outcomes) {
        auto found = asked_.extract(each.number);
        if (!found.empty() && found.mapped().asker) found.mapped().done(each);
    }
}

}  // namespace cortex::explorer
