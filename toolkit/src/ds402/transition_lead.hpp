// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/realtime.hpp"
#include "cortex/drives/ds402_state.hpp"

#include <cstdint>

namespace cortex::toolkit {

// An answer that is younger than this (s) may be one to the word before.
inline constexpr double ds402ExchangeTime = 0.05;

// Leads one CiA 402 drive to a state: it sends one control word, waits for the state that this word
// leads to, and sends the next. For hooks of one simplex.
class TransitionLead {
public:
    enum class Aim : std::uint8_t {
        None,
        Enable,
        Disable,    // from Operation enabled to Switched on
        QuickStop,  // where its option lets it stay: to Quick stop active, otherwise to power off
        PowerOff,   // Switch on disabled, whatever the option
        Reset,
        Step  // one transition
    };
    enum class Course : std::uint8_t { Idle, Goes, Reached, Refused };

    struct Seen {
        drives::Ds402State state;
        bool stands;
        bool modeShown;     // the drive is in the mode that is wished
        bool targetsThere;  // target and demand stand where the axis is
        std::int64_t quickStopOption;
    };

    void aimAt(Aim aim, bool resets = false) CORTEX_REALTIME;
    void aimAt(const drives::Ds402Transition& step) CORTEX_REALTIME;
    // Once a cycle. What was asked for and did not come within `timeout` s is Refused, once; then
    // nothing is aimed at and the word is a quick stop.
    Course advance(const Seen& seen, double seconds, double timeout) CORTEX_REALTIME;

    Aim aim() const { return aim_; }
    // Operation enabled was reached, and nothing else has been asked for since.
    bool hasArrived() const { return arrived_; }
    std::uint16_t word() const { return word_; }
    // What is aimed at in the end, and by the present word; Unknown: nothing.
    drives::Ds402State wanted(std::int64_t quickStopOption) const CORTEX_REALTIME;
    drives::Ds402State next() const { return next_; }
    void keep(Archive& archive) CORTEX_REALTIME {
        archive & aim_ & resets_ & arrived_ & stepCommand_ & stepEnd_ & last_ & next_ & word_ &
            waited_;
    }

private:
    bool isThere(const Seen& seen) const CORTEX_REALTIME;
    bool isInVain(const Seen& seen) const CORTEX_REALTIME;
    drives::Ds402Command commandIn(const Seen& seen) const CORTEX_REALTIME;
    drives::Ds402Command towardsEnabled(const Seen& seen) const CORTEX_REALTIME;
    void send(drives::Ds402Command command, const Seen& seen) CORTEX_REALTIME;
    bool isBraking(const Seen& seen) const CORTEX_REALTIME;
    void arrive() CORTEX_REALTIME;
    Course refuse() CORTEX_REALTIME;

    Aim aim_ = Aim::None;
    bool resets_ = false;   // Enable: it may begin with the reset of a fault
    bool arrived_ = false;  // Enable: it was there
    drives::Ds402Command stepCommand_ = drives::Ds402Command::None;
    drives::Ds402State stepEnd_ = drives::Ds402State::Unknown;
    drives::Ds402State last_ = drives::Ds402State::Unknown;
    drives::Ds402State next_ = drives::Ds402State::Unknown;
    std::uint16_t word_ = 2;
    double waited_ = 0;  // s, since the word or the state changed
};

}  // namespace cortex::toolkit
