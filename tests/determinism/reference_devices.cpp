// SPDX-License-Identifier: Apache-2.0
// Demands of the reference that a device takes, or does not.
#include "determinism/reference.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace cortex::determinism {
namespace {

bool hasRate(const Item& item) { return item.type->kind == Kind::Float && item.type->rate; }

bool derives(const RefSimplex& demand, const Item& item) {
    const Item* base = demand.shape->find(item.type->derivativeOf);
    return item.type->kind == Kind::Float && base != nullptr && hasRate(*base);
}

}  // namespace

void Reference::findDevices() {
    for (const Link& link : links_) {
        const bool reads = link.rule->direction == Direction::Input && !link.delayed;
        if (reads && at(link.target).demand && isActive(link.owner) &&
            at(link.owner).type->isA("Device"))
            at(link.target).devices.push_back(link.owner);
    }
}

void Reference::lookAtDevices(RefSimplex& demand) {
    if (demand.devices.empty()) return;
    demand.taken = std::ranges::any_of(
        demand.devices, [&](int each) { return at(each).live.state.quality != Quality::Lost; });
}

void Reference::standStill(RefSimplex& demand, double elapsed) {
    for (const Item& item : demand.shape->items) {
        const bool derived = derives(demand, item);
        if (!derived && !hasRate(item)) continue;
        for (std::size_t i = item.first; i < item.first + item.type->length; ++i) {
            const double before = demand.previous.floats[i];
            const double most = hasRate(item) ? *item.type->rate * elapsed : std::abs(before);
            const double slower =
                std::abs(before) > most ? before - std::copysign(most, before) : 0.0;
            demand.live.floats[i] = derived ? slower : before;
        }
    }
}

// Once for each time that they are all gone, or one is back.
void Reference::tellSteps(RefSimplex& demand, LimitFinding& finding) {
    if (demand.devices.empty() || demand.stood == !demand.taken) return;
    demand.stood = !demand.taken;
    if (demand.stood) {
        demand.whenLost = demand.live;
        return;
    }
    const bool first = !std::exchange(demand.wasTaken, true);
    if (first) return;
    for (const Item& item : demand.shape->items) {
        if (item.type->kind != Kind::Float || hasRate(item) || derives(demand, item)) continue;
        for (std::size_t i = item.first; i < item.first + item.type->length; ++i) {
            const double before = demand.whenLost.floats[i], now = demand.live.floats[i];
            if (before == now) continue;
            finding.steps.push_back(item.type->name + " of " + demand.path + " went from " +
                                    inText(before, now) + " to " + inText(now, before) +
                                    (item.type->unit.empty() ? "" : " " + item.type->unit) +
                                    " while " + at(demand.devices.front()).path +
                                    " was not connected");
            break;
        }
    }
}

}  // namespace cortex::determinism
