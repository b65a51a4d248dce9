// SPDX-License-Identifier: Apache-2.0
#include "commands/safe_refusal.hpp"

namespace cortex {
namespace {

std::optional<State> stateOf(const Structure& structure, const Tables& tables,
                             std::uint32_t writer) {
    const ItemLayout* item = structure.simplexes[writer].layout->find("state");
    if (item == nullptr || item->item->kind != Kind::Int) return {};
    return static_cast<State>(tables.live(writer).ints[item->offset]);
}

// Where a safe value stands, its writer is the cause; so is a writer that has said it of itself.
bool standsByLoss(const SlotState& demand, const SlotState& own, std::uint32_t writer) {
    if (demand.quality != Quality::Stale || demand.cause != writer) return false;
    return own.quality != Quality::Good && own.cause != writer;
}

}  // namespace

std::optional<EventText> safeRefusal(const Structure& structure, const Tables& tables,
                                     std::uint32_t simplex, const DataItem& item) {
    constexpr const char* inVain = "; a set would not act";
    const SimplexInfo& info = structure.simplexes[simplex];
    if (info.role != Role::Modification || info.writers.empty()) return {};
    EventText why{info.path};
    if (info.writers.size() > 1) {
        return why << " has several writers, and what one of them writes goes out" << inVain;
    }
    const std::uint32_t writer = info.writers.front();
    const auto state = stateOf(structure, tables, writer);
    if (!state || structure.simplexes[writer].remote) return {};
    const std::string& by = structure.simplexes[writer].path;
    const bool mayBeSafe = item.safe.kind != Safe::Kind::None && item.atRest != AtRest::Writer;
    const bool rests = *state == State::Standby || *state == State::Fault;
    const bool lacks =
        standsByLoss(*tables.live(simplex).state, *tables.live(writer).state, writer);
    if (mayBeSafe && (rests || lacks)) {
        why << " is a demand that is safe: its writer " << by;
        if (rests) return why << " is in " << name(*state) << inVain;
        return why << " has lost an input" << inVain;
    }
    if (*state == State::Active)
        return why << " is a demand that " << by << " writes, which is Active" << inVain;
    return {};
}

}  // namespace cortex
