// SPDX-License-Identifier: Apache-2.0
#include "agent/first_of_name.hpp"

#include "peers/owners.hpp"
#include "security/security_documents.hpp"
#include "wire/presence_extras.hpp"
#include "wire/presence_interval.hpp"

#include <algorithm>
#include <cstdlib>

namespace cortex::comms {
namespace {

constexpr std::int64_t tellAgain = 10'000'000'000;  // ns
// One that speaks for so long yields to nobody, however long it took until it heard this one.
constexpr std::int64_t settled = timeToMeet + 1'000'000'000;
constexpr std::int64_t timeToYield = settled + 2'000'000'000;  // after a standstill

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

// Empty: it is not known yet what this start has itself.
std::string FirstOfName::systemOf(const Presence& rival) const {
    if (!ownHeard_) return "";
    const bool isSame = rival.typesHash == ownTypes_ && rival.structureHash == ownStructure_;
    return (isSame ? ": the same system, started at " : ": another system, started at ") +
           utcText(rival.epoch / 1'000'000);
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
        ownTypes_ = ours.typesHash;
        ownStructure_ = ours.structureHash;
        ownPatience_ = patienceWith(ours);
        if (runs || isSecond_) return;
        const std::string forged = "somebody else says that " + self_.name + " is " + ours.state;
        note(forged, now);
        return tell(Severity::Warning, forged, now);
    }
    const std::string rival = "another start of " + self_.name + " is heard, on host " + ours.host;
    note(rival + systemOf(ours), now);
    if (ours.state == "silent") {  // it says so again and again, and ends nobody's silence
        if (!isSecond_) tell(Severity::Warning, rival + "; it is silent while this one runs", now);
        return;
    }
    if (runs) rivalHeard_ = now;
    rivalPatience_ = runs ? patienceWith(ours) : patienceAfterGoodbye(ours);
    if (!runs || isSecond_) return;
    if (isNew(now) && comesBefore(ours, now)) {
        yield(rival + "; it was there first, so this one is silent while it runs", now);
    } else if (!mayBeSucceeded(now)) {
        tell(Severity::Warning,
             rival + "; this one was there first, and nobody listens to that one", now);
    } else if (tookOver(ours, now)) {
        yield("another start of " + self_.name + " on host " + ours.host +
                  " took over while this one stood still, so this one is silent",
              now);
    }
}

void FirstOfName::yield(const std::string& why, std::int64_t now) {
    isSecond_ = true;
    told_ = 0;
    tell(Severity::Error, why, now);
}

// What stands still hears nobody. One that spoke before the standstill took nothing over.
void FirstOfName::stood(std::int64_t from, std::int64_t now) {
    const bool isAlone = rivalHeard_ == 0 || from - rivalHeard_ > rivalPatience_;
    if (isSecond_) rivalHeard_ = std::min(now, rivalHeard_ + (now - from));
    if (isSecond_ || !isAlone || now - from <= shortestPatience) return;
    stoodFrom_ = from;
    wentOn_ = now;
}

bool FirstOfName::mayBeSucceeded(std::int64_t now) const {
    return stoodFrom_ != 0 && now - wentOn_ <= timeToYield;
}

// One that is new itself yields to this one. One that ran before the standstill was silent until it
// took this one for lost.
bool FirstOfName::tookOver(const Presence& rival, std::int64_t now) const {
    const std::int64_t uptime = timeIn(rival, uptimeOfAgent), since = now - stoodFrom_;
    const std::int64_t patience = std::max(ownPatience_, shortestPatience);
    return (uptime < since ? uptime : since - patience) > settled;
}

void FirstOfName::expire(std::int64_t now) {
    if (began_ == 0) began_ = now;
    if (!isSecond_ || now - rivalHeard_ <= rivalPatience_) return;
    isSecond_ = false;
    stoodFrom_ = 0;
    began_ = now;
    told_ = 0;
    tell(Severity::Info, "the other start of " + self_.name + " has ended; this one speaks again",
         now);
}

}  // namespace cortex::comms
