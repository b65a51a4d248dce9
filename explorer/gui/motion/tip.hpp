// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <QString>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace cortex::explorer {

// What a CartesianJogController moves: the tip along x, y, z, then about them, then the elbow.
inline constexpr int tipMotions = 7, tipElbow = 6;

QString tipMotionName(int motion);                     // "X", "RX", "elbow"
inline bool turns(int motion) { return motion >= 3; }  // in rad/s, not in m/s

// The tip of a chain as its controller and its kinematics know it. Numbers are in m and rad.
struct Tip {
    std::array<bool, tipMotions> moves{};                // the controller may be asked for these
    std::array<std::optional<double>, tipMotions> most;  // greatest speed
    std::string pose;                                    // who has it; empty: nobody computes it
    std::string kinematics;                              // who computes it
    QString another;  // the item by which that is another tip: "tipPosition"; empty: it is this one
    std::array<std::optional<double>, 6> at;     // x y z, roll pitch yaw, in the base
    std::array<std::optional<double>, 2> speed;  // along and about any axis; none: not known now
    bool live = false;
    QString frame, heldBack;  // as the labels of the type say it: "Tip", "Singularity"
    double holdTime = 0;
    std::optional<double> singularDistance;  // none: it is not computed now
};

Tip tipOf(const SystemNow& now, const std::string& controller);
void refresh(Tip& tip, const SystemNow& now, const std::string& controller);

// The order that moves it so; it has no budget yet.
Order tipOrder(const std::string& controller, int motion, double velocity);

}  // namespace cortex::explorer
