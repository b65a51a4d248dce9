// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/waiting.hpp"
#include "session/session.hpp"
#include "window/control_bar.hpp"
#include "window/main_window.hpp"

#include <QPushButton>
#include <string>
#include <utility>

namespace cortex::test {

// Takes control as a person does, who presses again where an agent heard of it too late.
inline bool takesControl(gui::MainWindow& window, gui::Session& session,
                         const std::string& prefix) {
    bool isAsked = false;
    const auto press = [&] {
        window.control().choose();
        window.control().panel()->choose(prefix);
        window.control().panel()->takeButton().click();
    };
    press();
    return comes([&] {
        if (window.control().prefix() == prefix) return true;
        const gui::Control now = session.frame()->control;
        const bool asks = !now.asks.empty();
        if (std::exchange(isAsked, asks) && !asks && now.prefix.empty()) press();
        return false;
    });
}

}  // namespace cortex::test
