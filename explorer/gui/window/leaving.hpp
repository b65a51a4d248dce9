// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPointer>
#include <functional>
#include <memory>
#include <utility>

class QWidget;

namespace cortex::gui {

class ControlBar;
class Question;
class StartAgain;
struct KeptEdits;

// Asks before a window is closed that is in control, or would forget what Stop stopped.
class Leaving {
public:
    Leaving(QWidget& window, const ControlBar& control, const StartAgain& stopped,
            std::shared_ptr<const KeptEdits> kept)
        : window_{window}, control_{control}, stopped_{stopped}, kept_{std::move(kept)} {}

    // True: it may be closed. Otherwise the person is asked, once, and `yes` closes it.
    bool mayLeave(const std::function<void()>& yes);

private:
    void ask(const std::function<void()>& yes);

    QWidget& window_;
    const ControlBar& control_;
    const StartAgain& stopped_;
    std::shared_ptr<const KeptEdits> kept_;
    bool leaves_ = false;  // the person said so
    QPointer<Question> question_;
};

}  // namespace cortex::gui
