// SPDX-License-Identifier: Apache-2.0
#include "agent/link_table.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>

namespace cortex {
namespace {

constexpr std::int64_t patience = nsPerSecond;  // after the start, before it says what is missing
constexpr std::int64_t stalePeriods = 3;        // missed ones
constexpr std::int64_t reportedPeriods = 20;  // fewer happen often where nothing runs in real time
// ns, 2.3 years. What is older is as old as this, so ages add up along any number of agents.
constexpr std::int64_t oldest = std::int64_t{1} << 56U;

std::size_t octetsOf(const LinkBinding::Copy& copy) {
    const bool octets = copy.kind == Kind::Bool || copy.kind == Kind::String;
    return std::size_t{copy.length} * (octets ? 1U : 8U);
}

void apply(const std::vector<LinkBinding::Copy>& copies, const Slice& from, const Slice& to) {
    for (const LinkBinding::Copy& copy : copies) {
        copyCells(copy.kind, from.at(copy.kind, copy.from), to.at(copy.kind, copy.to),
                  octetsOf(copy));
    }
}

}  // namespace

LinkTable::LinkTable(AgentRuntime& runtime) : runtime_{runtime} {
    const auto& simplexes = runtime.structure().simplexes;
    for (std::uint32_t i = 0; i < simplexes.size(); ++i) {
        if (simplexes[i].remote) links_.push_back({i, runtime.tables().live(i)});
    }
    first_ = static_cast<std::uint32_t>(simplexes.size() - links_.size());
}

LinkTable::Link* LinkTable::find(std::uint32_t simplex) {
    return simplex >= first_ && simplex - first_ < links_.size() ? &links_[simplex - first_]
                                                                 : nullptr;
}

void LinkTable::offered(std::uint32_t simplex) {
    if (find(simplex) != nullptr) runtime_.everOffered_[simplex - first_] = true;
}

void LinkTable::link(std::uint32_t simplex, const LinkBinding& binding, const Slice& from,
                     std::int64_t age, std::uint32_t interface) {
    Link* link = find(simplex);
    if (link == nullptr || !binding.usable) return;
    apply(binding.copies, from, link->slice);
    SlotState& state = *link->slice.state;
    state = *from.state;
    state.cycle = 0;  // its owner counts cycles of its own
    state.time = runtime_.wokenAt() - std::min(age, oldest);
    state.cause = state.quality == Quality::Good ? noSimplex : simplex;
    link->freshTime = runtime_.nominalTime();
    link->period = std::max(binding.period, runtime_.options().period);
    runtime_.ownerPeriods_[simplex - runtime_.firstRemote_] = link->period;
    if (!link->bound) post(Severity::Info, simplex, "linked");
    setBound(*link, true);
    runtime_.everOffered_[simplex - first_] = true;
    runtime_.everLinked_[simplex - first_] = true;
    link->interface = interface;
    link->silent = 0;
    link->reported = false;
}

void LinkTable::constants(std::uint32_t simplex, const LinkBinding& binding, const Slice& from) {
    Link* link = find(simplex);
    if (link == nullptr || !binding.usable) return;
    apply(binding.constants, from, link->slice);
}

void LinkTable::lost(std::uint32_t simplex) {
    Link* link = find(simplex);
    if (link == nullptr || !link->bound) return;
    setBound(*link, false);
    ++runtime_.linkLosses_[simplex - first_];
    link->slice.state->quality = Quality::Lost;
    link->slice.state->cause = simplex;
    if (!link->reported) post(Severity::Warning, simplex, "link lost: its agent is not heard");
}

void LinkTable::setBound(Link& link, bool bound) {
    link.bound = bound;
    runtime_.linked_[link.simplex - first_].store(bound, std::memory_order_relaxed);
}

void LinkTable::age() {
    if (!toldMissing_ && runtime_.nominalTime() >= patience) {
        toldMissing_ = true;
        tellMissing(false, ", which no other agent has offered yet");
        tellMissing(true, ": linked, but no value has come");
    }
    for (Link& link : links_) {
        ++link.silent;
        const std::int64_t age = runtime_.nominalTime() - link.freshTime;
        if (!link.bound || age < stalePeriods * link.period) continue;
        SlotState& state = *link.slice.state;
        if (state.quality < Quality::Stale) {
            state.quality = Quality::Stale;
            state.cause = link.simplex;
        }
        // A loop that stood still has missed its own cycles, and the owner has said nothing wrong.
        const bool brief = age < reportedPeriods * link.period || link.silent <= reportedPeriods;
        if (link.reported || brief) continue;
        link.reported = true;
        post(Severity::Warning, link.simplex, "no fresh sample for 20 periods");
    }
}

// Once: whatever else follows from it is no news.
void LinkTable::tellMissing(bool offered, const char* what) {
    const Link* first = nullptr;
    std::int64_t others = -1;
    for (const Link& link : links_) {
        if (!runtime_.neverLinked(link.simplex)) continue;
        if (runtime_.everOffered(link.simplex) != offered) continue;
        if (first == nullptr) first = &link;
        ++others;
    }
    if (first == nullptr) return;
    EventText text{"waits for "};
    text << runtime_.structure().simplexes[first->simplex].path;
    if (others > 0) text << " and " << others << " more";
    text << what;
    runtime_.post(runtime_.thread(0), Severity::Warning, EventKind::Agent, runtime_.agentSimplex(),
                  text);
}

void LinkTable::post(Severity severity, std::uint32_t simplex, const char* text) {
    runtime_.post(runtime_.thread(0), severity, EventKind::Loss, simplex, text);
}

}  // namespace cortex
