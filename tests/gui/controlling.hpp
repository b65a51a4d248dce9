// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/taking.hpp"
#include "gui/window_fixture.hpp"
#include "views/command_card.hpp"
#include "views/life_cycle_bar.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"
#include "window/control_notice.hpp"

#include <QPushButton>
#include <algorithm>
#include <stdexcept>

namespace cortex::test {

class Controlling : public Window {
protected:
    using Window::Window;
    bool takes(const std::string& prefix) { return takesControl(window, session, prefix); }
    QPushButton& button(const QString& text) {
        const auto* bar = window.current()->findChild<LifeCycleBar*>();
        for (auto* each : bar->findChildren<QPushButton*>()) {
            if (each->text() == text) return *each;
        }
        throw std::runtime_error{"no such button"};
    }
    // Why the buttons of the life cycle cannot be pressed.
    bool says(const QString& reason) {
        window.refresh();
        const auto labels = window.current()->findChildren<TextLabel*>();
        return std::ranges::any_of(labels,
                                   [&](const auto* each) { return each->text().contains(reason); });
    }
    CommandCard& card(const std::string& command) {
        for (auto* each : window.current()->findChildren<CommandCard*>()) {
            if (each->command().name == command) return *each;
        }
        throw std::runtime_error{"no such command"};
    }
    bool isIn(const std::string& path, State state) {
        const auto frame = session.frame();
        const auto place = frame->find(path);
        return place && frame->agents[place->agent].state(place->simplex) == state;
    }
    static std::string leases() {
        return lookUntil([] { return live({"leases"}); },
                         [](const Outcome& seen) { return seen.exit == 0; })
            .output;
    }
};

// Another window of the same person or of a colleague, without a screen. It goes on while that of
// the test does.
struct Colleague {
    explicit Colleague(const std::string& person = {}) : session{ownNetwork(), person} {
        QObject::connect(&alive, &QTimer::timeout, [this] { session.isAlive(); });
        alive.start(100);
    }
    bool sees(const char* path) const { return session.frame()->find(path).has_value(); }
    const Control& control() {
        session.isAlive();
        now = session.frame()->control;
        return now;
    }
    Session session;
    Control now;
    QTimer alive;
};

}  // namespace cortex::test
