// SPDX-License-Identifier: Apache-2.0
#include "process/watchdog.hpp"

#include "process/scalar_output.hpp"

#include <algorithm>

namespace cortex::toolkit {

void Watchdog::populate() {
    const std::string item = itemName(*this, "item");
    for (const InputSimplex& each : inputs("watched")) {
        Watched watched{&each.state(), {}, {}};
        const DataItem* found = each.type().findData(item);
        const bool counts = found != nullptr && found->kind == Kind::Int;
        if (counts) watched.count = each.data<std::int64_t>(item);
        if (!counts && !item.empty()) watched.number = each.data<double>(item);
        watched.moves = item.empty() ? Moves::Nothing : counts ? Moves::Count : Moves::Number;
        watched_.push_back(watched);
    }
    timeout_ = data<const double>("timeout");
    lastChange_ = data<double>("lastChange");
    failing_ = data<std::int64_t>("failing");
    ok_ = output("ok").data<bool>("value");
}

bool Watchdog::stateStartingUp(const Tick& tick) {
    for (Watched& each : watched_) {
        each.last = numberOf(each);
        each.changedAt = tick.nominalTime;
    }
    return true;
}

double Watchdog::numberOf(const Watched& watched) {
    switch (watched.moves) {
        case Moves::Count:
            return static_cast<double>(watched.count.get());
        case Moves::Number:
            return watched.number;
        case Moves::Nothing:
            break;
    }
    return 0;
}

bool Watchdog::isAlive(Watched& watched, std::int64_t now) {
    const double number = numberOf(watched);
    if (number != watched.last) watched.changedAt = now;
    watched.last = number;
    const auto seconds = [now](std::int64_t since) {
        return static_cast<double>(now - since) * 1e-9;
    };
    const bool moves = watched.moves == Moves::Nothing || seconds(watched.changedAt) <= timeout_;
    // What nobody writes has no stamp.
    const bool young = watched.state->time == 0 || seconds(watched.state->time) <= timeout_;
    return moves && watched.state->quality == Quality::Good && young;
}

void Watchdog::stateActive(const Tick& tick) {
    std::int64_t failing = 0;
    double longest = 0;
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        Watched& each = watched_[i];
        if (!isAlive(each, tick.nominalTime) && failing == 0)
            failing = static_cast<std::int64_t>(i + 1);
        if (each.moves == Moves::Nothing) continue;
        longest = std::max(longest, static_cast<double>(tick.nominalTime - each.changedAt) * 1e-9);
    }
    failing_ = failing;
    lastChange_ = longest;
    ok_ = failing == 0;
    setQuality(Quality::Good);  // it vouches for what it says of the others
}

void Watchdog::keep(Archive& archive) {
    archive.version("Watchdog", 2);
    archive & watched_;
}

}  // namespace cortex::toolkit
