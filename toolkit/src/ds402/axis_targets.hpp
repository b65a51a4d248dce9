// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/core/realtime.hpp"

#include <cstdint>

namespace cortex::toolkit {

// In rad or m and s, N.m or N.
struct AxisTarget {
    double position = 0, velocity = 0, acceleration = 0, effort = 0;

    void keep(Archive& archive) CORTEX_REALTIME {
        archive & position & velocity & acceleration & effort;
    }
};

// What one drive is told of a demand, so that it never jumps: it stands where the axis is until the
// demand stands there too, and then follows it. For hooks of one simplex.
class AxisTargets {
public:
    // How far a demand may be away where following begins: rad or m, per s in modes of speed.
    static constexpr double tolerance = 0.01;
    static bool isOfPosition(int mode) CORTEX_REALTIME;

    enum class Course : std::uint8_t {
        Waits,
        Follows,
        NotHomed  // the demand moves, and where the axis is nobody knows
    };

    void standAt(double position) CORTEX_REALTIME;
    // In each cycle, before anything of this demand is asked.
    void see(const AxisTarget& demand, double seconds) CORTEX_REALTIME;
    // In a mode of operation of CiA 402, once a cycle. `observed`: position.
    Course follow(const AxisTarget& demand, int mode, bool homed, double observed, double seconds)
        CORTEX_REALTIME;
    // What is missing of the demand for following to begin.
    double away(const AxisTarget& demand, int mode) const CORTEX_REALTIME;
    // The demand is here; by position it rests here, too: one that passes by is not caught.
    bool mayJoin(const AxisTarget& demand, int mode) const CORTEX_REALTIME;
    const AxisTarget& target() const { return target_; }
    bool follows() const { return joined_; }

    // ProfilePosition: bits of the control word that hand over a target. `taken`: bit 12 of the
    // status word.
    std::uint16_t setPointBits(bool taken) CORTEX_REALTIME;

    void keep(Archive& archive) CORTEX_REALTIME {
        archive & target_ & offset_ & offsetSpeed_ & wished_ & seen_ & demandSpeed_ & joined_ &
            raised_;
    }

private:
    void reduceOffset(double seconds) CORTEX_REALTIME;

    AxisTarget target_;
    double offset_ = 0;       // of the target from the demand; it becomes 0 slowly
    double offsetSpeed_ = 0;  // by which it does
    double wished_ = 0;       // ProfilePosition: the next target
    double seen_ = 0;         // position of the demand, in the cycle before
    double demandSpeed_ = 0;  // the greater one of what it states and what it does
    bool joined_ = false;
    bool raised_ = false;  // ProfilePosition: bit 4
};

}  // namespace cortex::toolkit
