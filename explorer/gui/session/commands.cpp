// SPDX-License-Identifier: Apache-2.0
#include "session/commands.hpp"

#include "session/utc_now.hpp"

#include <chrono>
#include <utility>

namespace cortex::gui {

void Commands::send(const std::string& path, const std::string& command,
                    comms::Mirror::Arguments arguments, std::chrono::milliseconds limit,
                    QObject* asker, Done done, const std::string& keptAs,
                    std::chrono::milliseconds budget) {
    const std::uint64_t number = session_.send(path, command, std::move(arguments), limit, budget);
    Key key{path, keptAs.empty() ? command : keptAs};
    last_[key] = {number, std::nullopt};
    asked_.emplace(number, Asked{asker, std::move(done), std::move(key)});
}

void Commands::deliver(const std::vector<CommandOutcome>& outcomes) {
    for (CommandOutcome each : outcomes) {
        auto found = asked_.extract(each.number);
        if (found.empty()) continue;
        each.came = utcNow();
        Last& last = last_[found.mapped().key];
        if (last.number == each.number) last.outcome = each;
        if (found.mapped().asker) found.mapped().done(each);
    }
}

const Commands::Last* Commands::last(const std::string& path, const std::string& name) const {
    const auto found = last_.find({path, name});
    return found != last_.end() ? &found->second : nullptr;
}

}  // namespace cortex::gui
