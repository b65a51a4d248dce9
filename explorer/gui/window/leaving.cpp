// SPDX-License-Identifier: Apache-2.0
#include "window/leaving.hpp"

#include "session/item_edits.hpp"
#include "views/edit_bar.hpp"
#include "widgets/question.hpp"
#include "window/control_bar.hpp"
#include "window/start_again.hpp"

#include <QCoreApplication>

namespace cortex::gui {

namespace {

QString leaveText(const char* text, int count = -1) {
    return QCoreApplication::translate("Leaving", text, nullptr, count);
}

// That was entered in tables of data.
int unsentIn(const QWidget& window) {
    int count = 0;
    for (const auto* each : window.findChildren<EditBar*>()) count += each->unsent();
    return count;
}

}  // namespace

bool Leaving::mayLeave(const std::function<void()>& yes) {
    if (leaves_ || (!control_.holds() && stopped_.offer().isEmpty())) return true;
    if (!question_ || !question_->isVisible()) ask(yes);
    return false;
}

void Leaving::ask(const std::function<void()>& yes) {
    const bool holds = control_.holds();
    const QString title =
        holds ? leaveText("Release %1 and quit?").arg(control_.heldText()) : leaveText("Quit?");
    QStringList lines{leaveText("What is Active stays so.")};
    if (const int left = stopped_.left(); left > 0)
        lines
            << leaveText("What Stop stopped is forgotten; %1 of it is still in Standby.").arg(left);
    const int unsent = unsentIn(window_) + static_cast<int>(kept_->size());
    if (unsent > 0) lines << leaveText("%n entered values, not sent, are forgotten.", unsent);
    question_ = new Question{{title, lines, leaveText("Quit"), leaveText("Stay")}, &window_};
    QObject::connect(question_, &Question::pressed, &window_, [this, yes] {
        leaves_ = true;
        question_->close();
        yes();
    });
    question_->openAmid(window_);
}

}  // namespace cortex::gui
