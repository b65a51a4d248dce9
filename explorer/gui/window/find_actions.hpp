// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <functional>
#include <vector>

class QMenu;

namespace cortex::gui {

// Something that Ctrl+K does.
struct FindAction {
    QString text, keys;
    std::function<void()> run;
    bool discards = false;
};

// A property of an action that Ctrl+K leaves out: a word that is completed must not start a plant.
inline constexpr const char* onlyInMenu = "onlyInMenu";

// A property of an action that discards, resets or closes something: other things are found first.
inline constexpr const char* discardsSomething = "discardsSomething";

// A menu within one that has this property is offered, too.
inline constexpr const char* foundToo = "foundToo";

// What a menu offers now.
std::vector<FindAction> actionsOf(QMenu& menu);

}  // namespace cortex::gui
