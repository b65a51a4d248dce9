// SPDX-License-Identifier: Apache-2.0
#include "agent/lease.hpp"

#include <algorithm>

namespace cortex {
namespace {

constexpr std::int64_t lifetime = 2'000'000'000;  // ns since the last renewal

std::string_view trimmed(std::string_view prefix) {
    prefix = withoutEndSlashes(prefix);
    return prefix.empty() ? std::string_view{"/"} : prefix;
}

Outcome outsideOnly(Call& call) {
    return call.reject(Reason::Authority, "control is for agents and tools outside");
}

bool anySimplexBelow(const Structure& structure, std::string_view prefix) {
    if (prefix == "/") return true;
    const auto& all = structure.simplexes;  // sorted by path, then remote ones
    const auto end =
        std::ranges::partition_point(all, [](const auto& info) { return !info.remote; });
    const auto starts = [&](std::string_view text) {
        const auto found = std::ranges::lower_bound(
            all.begin(), end, text, {},
            [](const SimplexInfo& info) -> std::string_view { return info.path; });
        return found != end && isAtOrBelow(found->path, prefix);
    };
    return starts(prefix) || starts((EventText{prefix} << "/").view());
}

// The cells of an array item of eight, or null.
std::byte* arrayOf(AgentRuntime& runtime, std::string_view item, Kind kind, std::uint32_t& stride) {
    const std::uint32_t agent = runtime.agentSimplex();
    const ItemLayout* layout = runtime.structure().simplexes[agent].layout->find(item);
    if (layout == nullptr || layout->item->kind != kind || layout->item->constant ||
        layout->item->length < LeaseTable::capacity) {
        return nullptr;
    }
    stride = kind == Kind::String ? StringCell::size(layout->item->capacity) : 8U;
    return static_cast<std::byte*>(runtime.tables().live(agent).at(kind, layout->offset));
}

}  // namespace

bool Lease::heldBy(const Sender& sender) const {
    return held && holder.name == sender.name &&
           (holder.epoch == 0 || holder.epoch == sender.epoch);
}

void Lease::actFor(std::string_view person) {
    onBehalfOf = {};
    std::ranges::copy(person.substr(0, onBehalfOf.size() - 1), onBehalfOf.begin());
}

EventText Lease::holderText() const {
    EventText text{holder.nameText()};
    if (onBehalfOf.front() != '\0') text << " for " << onBehalfOf.data();
    return text;
}

EventText Lease::refusal() const {
    return EventText{prefix.view()} << " is held by " << holderText().view();
}

LeaseTable::LeaseTable(AgentRuntime& runtime)
    : lifetime_{std::max(lifetime / std::max(runtime.options().period, std::int64_t{1}),
                         std::int64_t{1})},
      structure_{runtime.structure()} {
    std::uint32_t stride = 0;
    prefixes_ = arrayOf(runtime, "leasePrefix", Kind::String, prefixStride_);
    holders_ = arrayOf(runtime, "leaseHolder", Kind::String, holderStride_);
    since_ = reinterpret_cast<std::int64_t*>(arrayOf(runtime, "leaseSince", Kind::Int, stride));
}

const Lease* LeaseTable::other(std::string_view path, bool wide, const Sender& sender) const {
    const auto found = std::ranges::find_if(leases_, [&](const Lease& lease) {
        return lease.held && !lease.heldBy(sender) &&
               (isAtOrBelow(path, lease.prefix.view()) ||
                (wide && isAtOrBelow(lease.prefix.view(), path)));
    });
    return found != leases_.end() ? &*found : nullptr;
}

bool LeaseTable::covered(std::string_view path, const Sender& sender) const {
    return std::ranges::any_of(leases_, [&](const Lease& lease) {
        return lease.heldBy(sender) && isAtOrBelow(path, lease.prefix.view());
    });
}

Outcome LeaseTable::take(Call& call, std::string_view prefix, std::int64_t cycle) {
    if (call.sender() == nullptr) return outsideOnly(call);
    prefix = trimmed(prefix);
    if (!anySimplexBelow(structure_, prefix)) {
        return call.reject(Reason::Range, (EventText{"no simplex below "} << prefix).view());
    }
    if (const Lease* lease = other(prefix, true, *call.sender())) {
        return call.reject(Reason::Authority, lease->refusal().view());
    }
    auto place = std::ranges::find_if(leases_, [&](const Lease& lease) {
        return lease.heldBy(*call.sender()) && lease.prefix.view() == prefix;
    });
    if (place == leases_.end()) place = std::ranges::find(leases_, false, &Lease::held);
    if (place == leases_.end()) return call.reject(Reason::Busy, "eight leases are held already");
    const std::int64_t since = place->held ? place->since : cycle;
    *place = {EventText{prefix}, *call.sender(), {}, since, cycle, true};
    place->actFor(call.onBehalfOf());
    show(*place);
    return Outcome::Done;
}

Lease* LeaseTable::mine(Call& call, std::string_view prefix) {
    if (call.sender() == nullptr) {
        outsideOnly(call);
        return nullptr;
    }
    prefix = trimmed(prefix);
    for (Lease& lease : leases_) {
        if (lease.heldBy(*call.sender()) && lease.prefix.view() == prefix) return &lease;
    }
    call.reject(Reason::Authority, (EventText{"it does not hold "} << prefix).view());
    return nullptr;
}

Outcome LeaseTable::renew(Call& call, std::string_view prefix, std::int64_t cycle) {
    Lease* lease = mine(call, prefix);
    if (lease == nullptr) return Outcome::Rejected;
    lease->holder = *call.sender();
    lease->actFor(call.onBehalfOf());
    lease->renewed = cycle;
    return Outcome::Done;
}

Outcome LeaseTable::handOver(Call& call, std::string_view prefix, std::string_view to,
                             std::int64_t cycle) {
    Lease* lease = mine(call, prefix);
    if (lease == nullptr) return Outcome::Rejected;
    if (to.empty() || to.size() >= lease->holder.name.size()) {
        return call.reject(Reason::Range, "'to' is not the name of an agent");
    }
    // What it holds further down goes along; what it keeps further up would forbid the rest.
    const Sender sender = *call.sender();
    for (const Lease& each : leases_) {
        if (&each == lease || !each.heldBy(sender)) continue;
        if (!isAtOrBelow(lease->prefix.view(), each.prefix.view())) continue;
        EventText why{"it holds "};
        why << each.prefix.view() << " too: hand that over, or release it first";
        return call.reject(Reason::Authority, why.view());
    }
    const EventText given = lease->prefix;
    for (Lease& each : leases_) {
        if (!each.heldBy(sender) || !isAtOrBelow(each.prefix.view(), given.view())) continue;
        each.holder = {};
        each.onBehalfOf = {};
        std::ranges::copy(to, each.holder.name.begin());
        each.since = each.renewed = cycle;
        show(each);
    }
    return Outcome::Done;
}

Outcome LeaseTable::release(Call& call, std::string_view prefix) {
    Lease* lease = mine(call, prefix);
    if (lease == nullptr) return Outcome::Rejected;
    *lease = {};
    show(*lease);
    return Outcome::Done;
}

bool LeaseTable::takeExpired(std::int64_t cycle, Lease& lost) {
    for (Lease& lease : leases_) {
        if (!lease.held || cycle - lease.renewed <= lifetime_) continue;
        lost = lease;
        lease = {};
        show(lease);
        return true;
    }
    return false;
}

bool LeaseTable::takeLeaseOf(const Sender& sender, Lease& lost) {
    for (Lease& lease : leases_) {
        // One handed over to a name waits for whichever start of it renews first.
        if (!lease.heldBy(sender) || lease.holder.epoch == 0) continue;
        lost = lease;
        lease = {};
        show(lease);
        return true;
    }
    return false;
}

void LeaseTable::show(const Lease& lease) {
    const std::size_t place = static_cast<std::size_t>(&lease - leases_.data());
    const auto text = [&](std::byte* cells, std::uint32_t stride, std::string_view value) {
        if (cells != nullptr) reinterpret_cast<StringCell*>(cells + place * stride)->assign(value);
    };
    text(prefixes_, prefixStride_, lease.prefix.view());
    text(holders_, holderStride_, lease.holder.nameText());
    if (since_ != nullptr) since_[place] = lease.since;
}

}  // namespace cortex
