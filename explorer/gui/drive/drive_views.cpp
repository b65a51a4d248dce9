// SPDX-License-Identifier: Apache-2.0
#include "drive/drive_views.hpp"

#include "drive/drive_view.hpp"
#include "drive/fieldbus_view.hpp"

#include <QCoreApplication>
#include <array>

namespace cortex::explorer {

namespace {

// Where F1 opens the manual, as the views of motion say it.
View* withManual(View* view) {
    view->setProperty("cortexManual", QCoreApplication::translate("Drive", "Drives"));
    return view;
}

// Two axes need more height than a small window has left below header and events.
View* makeDriveView(const std::string& path) {
    auto* view = new DriveView{path};
    view->setProperty("cortexRoom", true);
    return withManual(view);
}

View* makeFieldbusView(const std::string& path) { return withManual(new FieldbusView{path}); }

constexpr std::array viewsOfDrives{ViewType{"drive", "Drive", "Ds402Processor", &makeDriveView},
                                   ViewType{"link", "Link", "FieldbusDevice", &makeFieldbusView}};

}  // namespace

const Plugin& driveViews() {
    static const Plugin plugin{Plugin::current, viewsOfDrives.data(), viewsOfDrives.size()};
    return plugin;
}

}  // namespace cortex::explorer
