// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_self.hpp"

#include "cortex/core/clock.hpp"

#include "wire/ids.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <utility>

#include <unistd.h>

namespace cortex::comms {
namespace {

constexpr std::size_t mostReasons = 32;
constexpr std::int64_t longestLead = 86'400'000'000;  // us that another clock may be ahead

std::string hostName() {
    std::array<char, 64> host{};
    ::gethostname(host.data(), host.size() - 1);
    return host.data();
}

}  // namespace

bool isStart(std::int64_t epoch) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto utc = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
    return epoch > 0 && epoch <= utc + longestLead;
}

void Rejections::add(std::string_view reason) {
    const std::lock_guard lock{mutex_};
    count_.fetch_add(1, std::memory_order_relaxed);  // whoever sees it waits for the reason
    last_ = reason;
    auto found = reasons_.find(reason);
    if (found == reasons_.end()) {
        std::string text{reasons_.size() < mostReasons ? reason : "other reasons"};
        const auto isControl = [](char each) { return (each >= 0 && each < ' ') || each == 0x7f; };
        std::ranges::replace_if(text, isControl, '?');  // reasons have names of others
        found = reasons_.try_emplace(std::move(text)).first;
    }
    ++found->second.count;
}

std::vector<std::string> Rejections::takeReports(std::int64_t now) {
    std::vector<std::string> reports;
    const std::lock_guard lock{mutex_};
    for (auto& [text, reason] : reasons_) {
        const std::uint64_t more = reason.count - reason.reported;
        if (more == 0 || (reason.told != 0 && now - reason.told < nsPerSecond)) continue;
        reason.told = now;
        reason.reported = reason.count;
        reports.push_back(std::to_string(more) +
                          (more == 1 ? " sample was refused: " : " samples were refused: ") + text);
    }
    return reports;
}

std::map<std::string, std::uint64_t> Rejections::byReason() const {
    std::map<std::string, std::uint64_t> counts;
    const std::lock_guard lock{mutex_};
    for (const auto& [text, reason] : reasons_) counts[text] = reason.count;
    return counts;
}

std::string Rejections::last() const {
    const std::lock_guard lock{mutex_};
    return last_;
}

AgentSelf::AgentSelf(const AgentAccess& agent)
    : access{agent},
      name{agent.structure->agent},
      host{hostName()},
      id{agentId(name)},
      epoch{agent.structure->epoch},
      simplex{agent.structure->find("/" + name)},
      began{monotonicNow()} {}

void AgentSelf::event(Severity severity, std::uint32_t about, std::string_view text,
                      EventKind kind) const {
    Event event;
    if (const Image image = access.newestImage()) {
        event.cycle = image.cycle();
        event.time = image.nominalTime();
    }
    event.simplex = about;
    event.severity = severity;
    event.kind = kind;
    event.text = EventText{text};
    access.events->postOutside(event);
}

}  // namespace cortex::comms
