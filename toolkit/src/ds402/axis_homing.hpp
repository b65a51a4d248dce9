// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/realtime.hpp"
#include "cortex/drives/ds402_words.hpp"

#include <cstdint>
#include <string_view>

namespace cortex::toolkit {

inline constexpr int ds402HomingMode = static_cast<int>(drives::Ds402Mode::Homing);

// A method (6098) that the standard describes, or one of a maker, below 0. No drive has the others.
constexpr bool isHomingMethodOfCia402(std::int64_t method) {
    return method < 0 || (method >= 1 && method <= 14) || (method >= 17 && method <= 30) ||
           (method >= 33 && method <= 37);
}

// The handshake by which a CiA 402 drive finds its zero position: into the mode Homing, begin by
// bit 4, watch bits 10, 12 and 13, and back to the mode before. For hooks of one simplex.
class AxisHoming {
public:
    enum class Result : std::uint8_t {
        None,  // it runs, or never did
        Done,
        Failed,  // the drive says so
        Interrupted,
        NotBegun,
        TimedOut,
        Cancelled,
        Stopped,      // by a quick stop
        ModeRefused,  // it does not go into Homing
        ModeKept      // it does not come back from it
    };

    struct Seen {
        int mode;  // that the drive shows
        int modeBefore;
        drives::Ds402Homing status;
        bool stands;
        bool targetsThere;  // what goes out is where the axis is
        bool demandMoves;   // its controller still leads it to where the axis is
    };

    void begin() CORTEX_REALTIME;
    // Ends in order: bit 4 falls, the axis stands, the mode goes back.
    void stop(Result why) CORTEX_REALTIME;
    // Ends at once, as the axis is led elsewhere.
    void abort(Result why) CORTEX_REALTIME;
    // Once a cycle; `timeout`: s for a change of mode, and for a beginning.
    void advance(const Seen& seen, double seconds, double timeout) CORTEX_REALTIME;

    bool runs() const { return phase_ != Phase::Idle; }
    bool wantsMode() const { return runs() && phase_ != Phase::Leave; }  // Homing
    bool startBit() const { return phase_ == Phase::Search; }            // bit 4
    Result result() const { return result_; }
    double share() const CORTEX_REALTIME;  // that is done, in phases
    void keep(Archive& archive) CORTEX_REALTIME { archive & phase_ & result_ & moved_ & spent_; }

    // "could not find …"; empty for None and Done.
    static std::string_view words(Result result) CORTEX_REALTIME;

private:
    enum class Phase : std::uint8_t { Idle, Enter, Search, Brake, Leave };
    void go(Phase phase) CORTEX_REALTIME;
    void search(drives::Ds402Homing status, double timeout) CORTEX_REALTIME;

    Phase phase_ = Phase::Idle;
    Result result_ = Result::None;
    bool moved_ = false;  // it has been seen to run
    double spent_ = 0;    // s, in this phase
};

}  // namespace cortex::toolkit
