// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_summary.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"

#include "wire/presence_extras.hpp"

#include <algorithm>

namespace cortex::comms {
namespace {

constexpr std::int64_t interval = nsPerSecond / 5;

}  // namespace

AgentSummary::AgentSummary(AgentSelf& self, const Id& structureHash, Participant& participant)
    : self_{self}, participant_{participant} {
    summary_.agent = self.id;
    summary_.epoch = self.epoch;
    summary_.structureHash = structureHash;
}

void AgentSummary::update(const Peers& peers) {
    wanted_ = std::ranges::any_of(peers, [](const auto& each) {
        const Peer& peer = each.second;
        return peer.heard && numberIn(peer.current->interest, summaries) != 0;
    });
    if (wanted_) wanted_ = make();
}

bool AgentSummary::make() {
    if (!marks_) {
        const auto& simplexes = self_.structure().simplexes;
        const auto own = std::ranges::count(simplexes, false, &SimplexInfo::remote);
        marks_.emplace(self_.structure());
        summary_.marks.resize(static_cast<std::size_t>(own));
    }
    try {
        if (!writer_) writer_ = participant_.writer<Summary>(topics::summary);
    } catch (const Error& error) {
        self_.event(Severity::Error, self_.simplex, error.what());
    }
    return writer_ != nullptr;
}

// Also while the loop stands still: who begins to look then sees how all is.
void AgentSummary::step(std::int64_t now) {
    if (!wanted_ || now < due_) return;
    const Image image = self_.access.newestImage();
    if (!image || image.cycle() == 0) return;
    due_ = std::max(due_ + interval, now + interval / 2);
    summary_.cycle = image.cycle();
    for (std::uint32_t i = 0; i < summary_.marks.size(); ++i) {
        summary_.marks[i] = octetOf(marks_->of(i, image.slice(i)));
    }
    writer_->write(summary_);
}

}  // namespace cortex::comms
