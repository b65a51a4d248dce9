// SPDX-License-Identifier: Apache-2.0
#include "motion/motion_views.hpp"

#include "motion/axis_view.hpp"
#include "motion/tip_view.hpp"

#include <QCoreApplication>
#include <array>

namespace cortex::explorer {

namespace {

View* withHelp(View* view) {
    // Where F1 opens the manual: as ManualView::helpOf(), which a view does not see.
    view->setProperty("cortexManual", QCoreApplication::translate("Motion", "Moving axes"));
    return view;
}

View* makeAxisView(const std::string& path) { return withHelp(new AxisView{path}); }

View* makeTipView(const std::string& path) { return withHelp(new TipView{path}); }

constexpr std::array views{ViewType{"jog", "Jog", "JogController", &makeAxisView},
                           ViewType{"tip", "Jog", "CartesianJogController", &makeTipView},
                           ViewType{"pose", "Axes", "AxisPoseController", &makeAxisView}};

}  // namespace

const Plugin& motionViews() {
    static const Plugin plugin{Plugin::current, views.data(), views.size()};
    return plugin;
}

}  // namespace cortex::explorer
