// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

class QMenu;
class QWidget;

namespace cortex::gui {

// What the menu of a row of the tree can do with its path.
struct TreeActions {
    using Action = std::function<void(const std::string& path)>;
    Action open, openTab, takeControl, startAll, stopAll;
};

// The menu of a simplex, or of the part of the tree that begins at its path. It deletes itself.
QMenu* makeTreeMenu(const std::string& path, bool isSimplex, const TreeActions& actions,
                    QWidget* parent);

}  // namespace cortex::gui
