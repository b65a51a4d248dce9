// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_tools.hpp"

#include "cortex/core/printable.hpp"

#include "wire/ids.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace cortex::comms {
namespace {

constexpr std::size_t mostTools = 1024, mostRefusals = 8, longestName = 63, longestPrefix = 127;

bool isPlain(const std::string& text, std::size_t longest) {
    return !text.empty() && text.size() <= longest && text == printable(text);
}

std::string numbered(std::uint64_t number, const std::string& text) {
    return std::to_string(number) + ' ' + text;
}

// "NUMBER TEXT"; none: it is something else.
std::optional<std::pair<std::uint64_t, std::string>> taken(std::string_view said) {
    std::uint64_t number = 0;
    const auto [rest, error] = std::from_chars(said.data(), said.data() + said.size(), number);
    if (error != std::errc{} || number == 0 || rest == said.data() + said.size() || *rest != ' ')
        return {};
    return std::pair{number, std::string{rest + 1, said.data() + said.size()}};
}

ToolStatus statusOf(const Presence& presence) {
    ToolStatus status;
    status.name = presence.name;
    status.host = presence.host;
    status.security = presence.security;
    status.person = textIn(presence, userOfTool);
    const auto asks = taken(textIn(presence, asksFor));
    if (asks && canBeAskedFor(asks->second)) status.asks = {asks->first, asks->second};
    for (const Extra& extra : presence.extras) {
        if (extra.name != refusedAsk || status.refuses.size() == mostRefusals) continue;
        if (const auto refused = taken(extra.value))
            status.refuses.emplace_back(refused->second, refused->first);
    }
    return status;
}

}  // namespace

std::vector<Extra> ToolWords::extras() const {
    std::vector<Extra> extras;
    if (!person.empty()) extras.push_back({userOfTool, person});
    if (asks.number != 0) extras.push_back({asksFor, numbered(asks.number, asks.prefix)});
    for (const auto& [tool, number] : refuses) {
        extras.push_back({refusedAsk, numbered(number, tool)});
    }
    for (const std::string& each : past) extras.push_back({ofThePast, each});
    return extras;
}

bool isPersonName(const std::string& name) {
    return isPlain(name, longestName) && name.find_first_of("()") == std::string::npos &&
           !name.starts_with(' ') && !name.ends_with(' ');
}

std::string whoText(const std::string& tool, const std::string& person) {
    return person.empty() ? tool : person + " (" + tool + ")";
}

bool canBeAskedFor(const std::string& prefix) {
    if (prefix == "/") return true;
    return isPlain(prefix, longestPrefix) && prefix.front() == '/' && prefix.back() != '/' &&
           prefix.find("//") == std::string::npos && prefix.find(' ') == std::string::npos;
}

void MirrorTools::take(const Presence& presence, Moment now) {
    if (presence.role != "tool" || presence.name == self_) return;
    if (presence.agent != agentId(presence.name)) return;
    auto known = tools_.find(presence.name);
    const bool isOther = known != tools_.end() && known->second.presence.epoch != presence.epoch;
    if (presence.state != "running") {
        if (known != tools_.end() && !isOther) known->second.ends = true;
        return;
    }
    if (!isPersonName(textIn(presence, userOfTool))) {
        if (known != tools_.end() && !isOther) tools_.erase(known);
        return;
    }
    const bool holdsName =
        isOther && now - known->second.heard <=
                       std::chrono::nanoseconds{patienceWithRival(known->second.presence)};
    if (holdsName || (known == tools_.end() && tools_.size() >= mostTools)) return;
    tools_.insert_or_assign(presence.name, Tool{presence, now});
}

void MirrorTools::withdraw(const Id& tool) {
    for (auto& [name, each] : tools_) {
        if (each.presence.agent == tool) each.ends = true;
    }
}

bool MirrorTools::isGone(const Tool& tool, Moment now) const {
    const std::int64_t patience =
        tool.ends ? patienceAfterGoodbye(tool.presence) : patienceWith(tool.presence);
    return now - tool.heard > std::chrono::nanoseconds{patience};
}

void MirrorTools::tick(Moment now) {
    std::erase_if(tools_, [&](const auto& each) { return isGone(each.second, now); });
}

void MirrorTools::excuse(std::chrono::nanoseconds still, Moment now) {
    for (auto& [name, each] : tools_) each.heard = std::min(now, each.heard + still);
}

std::vector<ToolStatus> MirrorTools::list() const {
    std::vector<ToolStatus> list;
    for (const auto& [name, each] : tools_) list.push_back(statusOf(each.presence));
    return list;
}

}  // namespace cortex::comms
