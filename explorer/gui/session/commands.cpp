// SPDX-License-Identifier: Apache-2.0
#include "session/commands.hpp"

#include "cortex/core/command_sentence.hpp"
#include "cortex/core/event.hpp"

#include "session/item_edits.hpp"
#include "session/utc_now.hpp"

#include <chrono>
#include <string_view>
#include <utility>

namespace cortex::gui {

namespace {

// "tool", "tool@desk", "tool for Ada"
bool isFrom(std::string_view sender, std::string_view self) {
    if (!sender.starts_with(self)) return false;
    sender.remove_prefix(self.size());
    return sender.empty() || sender.front() == '@' || sender.front() == ' ';
}

// The names in "a=1, b=2 3"; an empty one where not all of them are left.
std::vector<std::string> itemsIn(const CommandSentence& set) {
    if (set.outcome.empty() || set.arguments.ends_with("…")) return {std::string{}};
    std::vector<std::string> items;
    for (std::size_t begin = 0, end = 0; begin < set.arguments.size(); begin = end) {
        const std::size_t equals = set.arguments.find('=', begin);
        if (equals == std::string_view::npos) break;
        items.emplace_back(set.arguments.substr(begin, equals - begin));
        end = set.arguments.find(", ", equals);
        end = end == std::string_view::npos ? set.arguments.size() : end + 2;
    }
    return items;
}

}  // namespace

Commands::Commands(Session& session)
    : session_{session}, keptEdits_{std::make_shared<KeptEdits>()} {}

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

void Commands::hear(const std::vector<comms::AgentEvent>& events, const std::string& self) {
    for (const comms::AgentEvent& each : events) {
        if (each.kind != name(EventKind::Command)) continue;
        const auto sentence = commandSentence(each.text);
        if (!sentence || sentence->command != "set" || isFrom(sentence->sender, self)) continue;
        for (std::string& item : itemsIn(*sentence)) ++setByOthers_[{each.path, std::move(item)}];
    }
}

std::uint64_t Commands::setByOthers(const std::string& path, const std::string& item) const {
    std::uint64_t count = 0;
    for (const std::string& each : {item, std::string{}}) {
        const auto found = setByOthers_.find({path, each});
        if (found != setByOthers_.end()) count += found->second;
    }
    return count;
}

}  // namespace cortex::gui
