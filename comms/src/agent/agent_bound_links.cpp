// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_bound_links.hpp"

#include "cortex/core/clock.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

// The constants of a simplex as its agent sets them.
void storeConstants(const Structure& structure, std::uint32_t simplex, const Slice& to) {
    for (const InitialValue& initial : structure.initial) {
        if (initial.simplex != simplex || !initial.item->constant) continue;
        const DataItem& item = *initial.item->item;
        storeValue(item, initial.value, to.at(item.kind, initial.item->offset));
    }
}

std::vector<const TypeLayout*> layoutsOf(const std::vector<std::shared_ptr<BoundLink>>& links) {
    std::vector<const TypeLayout*> layouts;
    for (const auto& link : links) layouts.push_back(&link->layout);
    return layouts;
}

}  // namespace

BoundLink::BoundLink(std::uint64_t number, std::uint32_t ours, const std::string& owner,
                     const LinkClaim& claimed)
    : serial{number},
      simplex{ours},
      agent{owner},
      claim{claimed},
      layout{*claimed.structure->simplexes[claimed.theirs].layout},
      constants{layout, true} {
    storeConstants(*claim.structure, claim.theirs, constants.slice());
}

BoundGroup::BoundGroup(std::vector<std::shared_ptr<BoundLink>> theirs)
    : links{std::move(theirs)}, buffer{layoutsOf(links)} {
    for (std::size_t i = 0; i < links.size(); ++i) places[links[i]->claim.theirs] = i;
}

BoundLinks::BoundLinks(const std::vector<std::uint32_t>& simplexes) {
    for (const std::uint32_t simplex : simplexes) seen_.push_back({.simplex = simplex});
    offer(std::vector<std::shared_ptr<BoundLink>>(seen_.size()));
}

void BoundLinks::offer(const std::vector<std::shared_ptr<BoundLink>>& links) {
    std::map<std::string, std::vector<std::shared_ptr<BoundLink>>> byAgent;
    for (const auto& link : links) {
        if (link) byAgent[link->agent].push_back(link);
    }
    auto next = std::make_unique<Offer>();
    for (auto& [agent, theirs] : byAgent) next->groups.push_back(groupOf(std::move(theirs)));
    next->places.resize(links.size());
    for (const auto& group : next->groups) {
        for (std::size_t place = 0; place < group->links.size(); ++place) {
            const auto link = std::ranges::find(links, group->links[place]) - links.begin();
            next->places[static_cast<std::size_t>(link)] = {group->links[place].get(), group.get(),
                                                            place};
        }
    }
    kept_.push_back(std::move(next));
    const Offer* const offered = kept_.back().get();
    offered_.store(offered);
    // From here on the loop can only begin to use the one that is offered.
    const Offer* const used = inUse_.load();
    std::erase_if(kept_,
                  [&](const auto& each) { return each.get() != offered && each.get() != used; });
}

std::shared_ptr<BoundGroup> BoundLinks::groupOf(
    std::vector<std::shared_ptr<BoundLink>> links) const {
    std::shared_ptr<BoundGroup> before;
    if (!kept_.empty()) {
        for (const auto& each : groups()) {
            if (each->links == links) return each;
            if (each->agent() == links.front()->agent) before = each;
        }
    }
    auto group = std::make_shared<BoundGroup>(std::move(links));
    if (!before) return group;
    for (std::size_t place = 0; place < group->links.size(); ++place) {
        const auto old = std::ranges::find(before->links, group->links[place]);
        if (old == before->links.end()) continue;
        const auto was = static_cast<std::size_t>(old - before->links.begin());
        group->buffer.writable(place).copy(before->buffer.published(was));
    }
    group->buffer.publish();
    return group;
}

void BoundLinks::read(Inbox& inbox) {
    if (seen_.empty()) return;
    // The order matters: see the second invariant.
    const Offer* const offer = offered_.load();
    inUse_.store(offer);
    if (offered_.load() != offer) return;  // replaced just now; the next cycle looks again
    for (const auto& group : offer->groups) group->taken = &group->buffer.take();
    const std::int64_t now = monotonicNow();
    for (std::size_t i = 0; i < seen_.size(); ++i) read(seen_[i], offer->places[i], inbox, now);
}

void BoundLinks::read(Seen& seen, const Place& at, Inbox& inbox, std::int64_t now) {
    const std::uint64_t serial = at.link != nullptr ? at.link->serial : 0;
    const bool isOther = std::exchange(seen.serial, serial) != serial;
    if (isOther && std::exchange(seen.live, false)) inbox.linkLost(seen.simplex);
    if (at.link == nullptr) return;
    if (isOther) inbox.linkOffered(seen.simplex);
    const LinkBuffer::Sample& sample = (*at.group->taken)[at.place];
    if (sample.number <= seen.number) return;
    seen.number = sample.number;
    const LinkBinding& binding = at.link->claim.binding;
    if (!std::exchange(seen.live, true)) {
        inbox.linkConstants(seen.simplex, binding, at.link->constants.slice());
    }
    const std::int64_t underway = std::max(now - sample.came, std::int64_t{0});
    inbox.link(seen.simplex, binding, sample.values.slice(), sample.age + underway);
}

}  // namespace cortex::comms
