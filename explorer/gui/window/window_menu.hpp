// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "widgets/unit_menu.hpp"

#include <QString>
#include <functional>

class QMenu;
class QWidget;

namespace cortex::gui {

class ControlBar;
class LayoutKeeper;
class Orders;
class StopButton;

struct WindowActions {
    Session& session;
    Orders& orders;
    ControlBar& control;
    std::function<void()> nextTheme;
    std::function<void(double)> scale;
    std::function<void(bool)> localTime;
    std::function<void()> openManual, quit, find;
    std::function<void(const QString&)> openKind;
    std::function<void()> split, reopen, newPlot, plot;
    std::function<UnitsOfView()> units;  // of the view in front
    LayoutKeeper& layout;
};

// The menu of the window.
QMenu* makeWindowMenu(const WindowActions& actions, QWidget* parent);

// Fills a menu with how often values are taken. The tick follows the session, which the command
// line may have set.
void addRates(QMenu& menu, Session& session);

// Fills a menu with the zones in which times are shown.
void addTimes(QMenu& menu, const std::function<void(bool)>& choose);

// Fills a menu, each time it opens, with what the Stop button and F12 may stop from then on.
void addScopes(QMenu& menu, Session& session, StopButton& stop);

}  // namespace cortex::gui
