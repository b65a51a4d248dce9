// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <functional>
#include <string>

class QMenu;
class QWidget;

namespace cortex::gui {

// What the menu of a row of the tree can do with its path.
struct TreeActions {
    using Action = std::function<void(const std::string& path)>;
    Action open, openTab, takeControl;
    // Of all agents, or of one.
    std::function<void(const std::string& path, const std::string& agent)> startAll, stopAll;
};

// The menu of a simplex, or of the part of the tree that begins at its path. An agent's own row
// stands for all that the agent has. It deletes itself.
QMenu* makeTreeMenu(const Frame& frame, const std::string& path, const TreeActions& actions,
                    QWidget* parent);

}  // namespace cortex::gui
