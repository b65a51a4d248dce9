// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_self.hpp"

#include "wire/ids.hpp"

#include <array>

#include <unistd.h>

namespace cortex::comms {
namespace {

std::string hostName() {
    std::array<char, 64> host{};
    ::gethostname(host.data(), host.size() - 1);
    return host.data();
}

}  // namespace

void Rejections::add(std::string_view reason) {
    count_.fetch_add(1, std::memory_order_relaxed);
    const std::lock_guard lock{mutex_};
    last_ = reason;
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
      simplex{agent.structure->find("/" + name)} {}

void AgentSelf::event(Severity severity, std::uint32_t about, std::string_view text) const {
    Event event;
    if (const Image image = access.newestImage()) {
        event.cycle = image.cycle();
        event.time = image.nominalTime();
    }
    event.simplex = about;
    event.severity = severity;
    event.kind = EventKind::Agent;
    event.text = EventText{text};
    access.events->postOutside(event);
}

}  // namespace cortex::comms
