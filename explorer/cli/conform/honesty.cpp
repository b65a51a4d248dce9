// SPDX-License-Identifier: Apache-2.0
#include "conform/honesty.hpp"

#include "conform/judgement.hpp"

#include <algorithm>

namespace cortex::cli::conform {
namespace {

constexpr std::size_t needed = 4;

std::string secondsText(std::int64_t time) {
    return numberText(static_cast<double>(time) * 1e-9, 6) + " s";
}

std::string inCycle(std::int64_t cycle) { return " in cycle " + std::to_string(cycle); }

}  // namespace

Honesty::Honesty(const Plant& plant)
    : plant_{plant}, isFieldbus_{plant.deviceIs("FieldbusDevice")} {}

Honesty::Look Honesty::look(const Sample& sample) const {
    Look look{.cycle = sample.cycle, .time = sample.time, .stamps = {}};
    for (const std::uint32_t each : plant_.observations) {
        look.stamps.push_back(sample.slot(each).time);
    }
    if (!isFieldbus_) return look;
    look.age = sample.at(plant_.device, "age");
    look.isOpen = sample.count(plant_.device, "link") == linkIsOpen;
    for (std::size_t i = 0; i < counterNames.size(); ++i) {
        look.counters[i] = sample.at(plant_.device, counterNames[i]);
    }
    return look;
}

void Honesty::take(const Sample& sample) {
    ++cycles_;
    last_.push_back(look(sample));
    if (last_.size() > needed) last_.pop_front();
    if (last_.size() < 2) return;
    checkStamps(last_[last_.size() - 2], last_.back());
    if (!isFieldbus_) return;
    checkCounters(last_[last_.size() - 2], last_.back());
    if (last_.size() < needed) return;
    checkAge();
    checkClosed();
}

void Honesty::checkStamps(const Look& before, const Look& now) {
    for (std::size_t i = 0; i < now.stamps.size() && stamps_.empty(); ++i) {
        const std::string& path = plant_.path(plant_.observations[i]);
        if (now.stamps[i] > now.time) {
            stamps_ = path + " has a stamp of " + secondsText(now.stamps[i]) + inCycle(now.cycle) +
                      ", which was at " + secondsText(now.time) +
                      ": a measurement cannot be younger than the cycle that has it; look at what "
                      "is given to setQuality()";
        } else if (now.stamps[i] < before.stamps[i]) {
            stamps_ = path + " had a stamp of " + secondsText(before.stamps[i]) +
                      " and has one of " + secondsText(now.stamps[i]) + inCycle(now.cycle) +
                      ": stamps never go back; look at what is given to setQuality()";
        }
    }
}

void Honesty::checkCounters(const Look& before, const Look& now) {
    for (std::size_t i = 0; i < counterNames.size() && counters_.empty(); ++i) {
        if (now.counters[i] >= before.counters[i]) continue;
        counters_ = std::string{counterNames[i]} + " fell from " +
                    numberText(before.counters[i], 12) + " to " + numberText(now.counters[i], 12) +
                    inCycle(now.cycle) +
                    ": a counter counts from the start and never falls, also after reconnect()";
    }
}

void Honesty::checkAge() {
    const Look &before = last_[1], &now = last_[2];
    if (last_[3].answered() != last_[0].answered() || now.age >= before.age || !age_.empty())
        return;
    age_ = "age fell from " + numberText(before.age, 4) + " to " + numberText(now.age, 4) + " ms" +
           inCycle(now.cycle) + " while exchangeCount stayed at " + numberText(now.answered(), 12) +
           (before.isOpen || now.isOpen ? "" : " and the link was not Open") +
           ": it falls only when another answer comes; look at where age is written";
}

void Honesty::checkClosed() {
    if (std::ranges::any_of(last_, [](const Look& each) { return each.isOpen; })) return;
    const Look &before = last_[1], &now = last_[2], &first = last_[0], &newest = last_[3];
    const bool answered = newest.answered() != first.answered();
    if (answered && newest.reconnected() != first.reconnected()) return;
    for (std::size_t i = 0; i < now.stamps.size() && stamps_.empty(); ++i) {
        if (now.stamps[i] == before.stamps[i]) continue;
        stamps_ = plant_.path(plant_.observations[i]) + " got a newer stamp" + inCycle(now.cycle) +
                  " while " + (answered ? "exchangeCount grew to " : "exchangeCount stayed at ") +
                  numberText(newest.answered(), 12) + " and the link was not Open: " +
                  (answered ? "only an open link brings an answer; look at where link is written"
                            : "an old value with a fresh stamp misleads whoever reads it; look at "
                              "what is given to setQuality()");
    }
}

}  // namespace cortex::cli::conform
