// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPointer>
#include <functional>

class QWidget;

namespace cortex::gui {

class Commands;
class ControlBar;
class Question;
class StartAgain;

// Asks before a window is closed that is in control, or would forget something: what Stop stopped,
// and what was entered or typed and not sent.
class Leaving {
public:
    Leaving(QWidget& window, const ControlBar& control, const StartAgain& stopped,
            Commands& commands)
        : window_{window}, control_{control}, stopped_{stopped}, commands_{commands} {}

    // True: it may be closed. Otherwise the person is asked, once, and `yes` closes it.
    bool mayLeave(const std::function<void()>& yes);

private:
    void ask(const std::function<void()>& yes);
    int unsent() const;

    QWidget& window_;
    const ControlBar& control_;
    const StartAgain& stopped_;
    Commands& commands_;
    bool leaves_ = false;  // the person said so
    QPointer<Question> question_;
};

}  // namespace cortex::gui
