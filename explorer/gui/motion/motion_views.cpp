// SPDX-License-Identifier: Apache-2.0
#include "motion/motion_views.hpp"

#include "motion/axis_view.hpp"

#include <array>

namespace cortex::explorer {

namespace {

View* makeAxisView(const std::string& path) { return new AxisView{path}; }

constexpr std::array views{ViewType{"jog", "Jog", "JogController", &makeAxisView},
                           ViewType{"pose", "Axes", "AxisPoseController", &makeAxisView}};

}  // namespace

const Plugin& motionViews() {
    static const Plugin plugin{Plugin::current, views.data(), views.size()};
    return plugin;
}

}  // namespace cortex::explorer
