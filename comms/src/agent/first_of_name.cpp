// SPDX-License-Identifier: Apache-2.0
#include "agent/first_of_name.hpp"

#include "peers/owners.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <cstdlib>

namespace cortex::comms {
namespace {

constexpr std::int64_t tellAgain = 10'000'000'000;  // ns

}  // namespace

void FirstOfName::tell(Severity severity, const std::string& text, std::int64_t now) {
    if (told_ != 0 && now - told_ < tellAgain) return;
    told_ = now;
    self_.event(severity, self_.simplex, text);
}

void FirstOfName::note(const std::string& text, std::int64_t now) {
    noted_ = now;
    other_ = text;
}

std::string FirstOfName::otherSelf(std::int64_t now) const {
    return other_.empty() || now - noted_ > tellAgain ? "" : other_;
}

bool FirstOfName::isNew(std::int64_t now) const {
    return began_ == 0 || now - began_ <= timeToMeet;
}

// Of two that began nearly at once both must come to the same end, so their epochs decide.
bool FirstOfName::comesBefore(const Presence& rival, std::int64_t now) const {
    const auto uptime = static_cast<std::int64_t>(numberIn(rival, uptimeOfAgent));
    const std::int64_t longer = uptime - (now - began_);
    if (uptime > 0 && std::abs(longer) < nearlyAtOnce) return rival.epoch < self_.epoch;
    return uptime <= 0 || longer > 0;
}

void FirstOfName::hear(const Presence& ours, std::int64_t now) {
    if (began_ == 0) began_ = now;
    const bool runs = ours.state == "running";
    if (ours.epoch == self_.epoch) {
        ownHeard_ = true;
        if (runs || isSecond_) return;
        const std::string forged = "somebody else says that " + self_.name + " is " + ours.state;
        note(forged, now);
        return tell(Severity::Warning, forged, now);
    }
    const std::string rival = "another start of " + self_.name + " is heard, on host " + ours.host;
    note(rival, now);
    if (ours.state == "silent") {  // it says so again and again, and ends nobody's silence
        if (!isSecond_) tell(Severity::Warning, rival + "; it is silent while this one runs", now);
        return;
    }
    if (runs) rivalHeard_ = now;
    rivalPatience_ = runs ? patienceWith(ours) : patienceAfterGoodbye(ours);
    if (!runs || isSecond_) return;
    if (isNew(now) && comesBefore(ours, now)) {
        isSecond_ = true;
        told_ = 0;
        tell(Severity::Error, rival + "; it was there first, so this one is silent while it runs",
             now);
    } else {
        tell(Severity::Warning,
             rival + "; this one was there first, and nobody listens to that one", now);
    }
}

void FirstOfName::expire(std::int64_t now) {
    if (began_ == 0) began_ = now;
    if (!isSecond_ || now - rivalHeard_ <= rivalPatience_) return;
    isSecond_ = false;
    began_ = now;
    told_ = 0;
    tell(Severity::Info, "the other start of " + self_.name + " has ended; this one speaks again",
         now);
}

}  // namespace cortex::comms
