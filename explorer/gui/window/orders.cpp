// SPDX-License-Identifier: Apache-2.0
#include "window/orders.hpp"

#include "window/control_bar.hpp"
#include "window/control_notice.hpp"
#include "window/stop_button.hpp"

#include <QPushButton>

namespace cortex::gui {

Orders::Orders(Session& session, StopButton& stop, ControlBar& control, QObject* parent)
    : QObject{parent}, stop_{stop}, control_{control}, all_{session}, again_{session} {
    connect(&stop, &StopButton::begun, this, [this] {
        all_.forget();
        again_.note(stop_.worked());
    });
    connect(&all_, &StartAll::begun, &again_, &StartAgain::forget);
    connect(&again_, &StartAgain::begun, &all_, &StartAll::forget);
    const auto startsAnew = [this] { stop_.forget(); };
    connect(&all_, &StartAll::begun, this, startsAnew);
    connect(&again_, &StartAgain::begun, this, startsAnew);
    const auto ask = [this](const std::string& prefix) { control_.choose(prefix); };
    connect(&all_, &StartAll::controlWanted, this, ask);
    connect(&again_, &StartAgain::controlWanted, this, ask);
    connect(&control, &ControlBar::declined, &all_, &StartAll::forget);
    connect(&control, &ControlBar::declined, &again_, &StartAgain::decline);
    const ControlNotice& notice = control.notice();
    connect(&control.notice().againButton(), &QPushButton::clicked, &again_, &StartAgain::begin);
    connect(&notice, &ControlNotice::outcomeClosed, this, [this] {
        if (told().isEmpty()) said_.clear();
        if (all_.text().isEmpty()) again_.close();
        tell();
    });
}

void Orders::refresh(const Frame& frame, const std::vector<CommandOutcome>& outcomes) {
    stop_.refresh(frame, outcomes);
    all_.refresh(frame, outcomes);
    again_.refresh(frame, outcomes, stop_.isStopping());
    tell();
}

void Orders::say(const QString& text) {
    said_ = text;
    tell();
}

// What a start of something else says is not about what Stop stopped.
QString Orders::told() const {
    for (const QString& text : {all_.text(), again_.text(), stop_.progress()})
        if (!text.isEmpty()) return text;
    return again_.leftText();
}

void Orders::tell() {
    const QString text = told();
    const QString offer = all_.text().isEmpty() ? again_.offer() : QString{};
    control_.notice().tell(text.isEmpty() ? said_ : text, offer);
}

}  // namespace cortex::gui
