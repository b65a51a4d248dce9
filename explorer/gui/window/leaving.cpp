// SPDX-License-Identifier: Apache-2.0
#include "window/leaving.hpp"

#include "session/commands.hpp"
#include "session/item_edits.hpp"
#include "views/edit_bar.hpp"
#include "widgets/item_field.hpp"
#include "widgets/question.hpp"
#include "window/control_bar.hpp"
#include "window/start_again.hpp"

#include <QCoreApplication>

namespace cortex::gui {

namespace {

QString leaveText(const char* text, int count = -1) {
    return QCoreApplication::translate("Leaving", text, nullptr, count);
}

}  // namespace

// That was entered in tables of data, is typed in one of their fields, or in a form.
int Leaving::unsent() const {
    auto count = static_cast<int>(commands_.keptEdits()->size()) + commands_.typed().unsent();
    for (const auto* each : window_.findChildren<EditBar*>()) count += each->unsent();
    for (const auto* each : window_.findChildren<ItemField*>()) count += each->isModified() ? 1 : 0;
    return count;
}

bool Leaving::mayLeave(const std::function<void()>& yes) {
    const bool loses = control_.holds() || !stopped_.offer().isEmpty() || unsent() > 0;
    if (leaves_ || !loses) return true;
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
    if (const int count = unsent(); count > 0)
        lines << leaveText("%n entered values, not sent, are forgotten.", count);
    question_ = new Question{{title, lines, leaveText("Quit"), leaveText("Stay")}, &window_};
    QObject::connect(question_, &Question::pressed, &window_, [this, yes] {
        leaves_ = true;
        question_->close();
        yes();
    });
    question_->openAmid(window_);
}

}  // namespace cortex::gui
