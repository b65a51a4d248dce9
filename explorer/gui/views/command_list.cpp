// SPDX-License-Identifier: Apache-2.0
#include "views/command_list.hpp"

#include "style/look.hpp"
#include "views/command_card.hpp"
#include "widgets/text_label.hpp"

#include <QScrollBar>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

namespace cortex::gui {

CommandList::CommandList(Commands& commands, QWidget* parent)
    : QScrollArea{parent}, commands_{commands} {
    setAccessibleName(tr("Commands"));
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
}

void CommandList::show(const Frame& frame, Place place) {
    const std::string& path = frame.info(place).path;
    const Type& type = frame.type(place);
    if (path == path_ && type.commands == shown_) return;
    scrolled_[path_] = verticalScrollBar()->value();
    path_ = path;
    shown_ = type.commands;
    cards_.clear();
    auto* all = new QWidget;
    auto* rows = new QVBoxLayout{all};
    rows->setContentsMargins(0, Look::units(1), 0, Look::units(1));
    rows->setSpacing(Look::units(2));
    for (const Command& each : shown_) {
        cards_.push_back(new CommandCard{commands_, path_, each});
        rows->addWidget(cards_.back());
    }
    if (shown_.empty()) {
        auto* none = new TextLabel{TextSize::Text, false, &Tokens::ink2};
        none->show(tr("Its type has no commands."));
        none->setContentsMargins(Look::units(4), 0, 0, 0);
        rows->addWidget(none);
    }
    rows->addStretch(1);
    setWidget(all);
    verticalScrollBar()->setValue(scrolled_[path_]);
}

void CommandList::refresh(const Frame& frame, Place place) {
    for (CommandCard* each : cards_) each->refresh(frame, place);
}

// Where its Run is off, the keyboard scrolls the forms.
bool CommandList::choose(const std::string& command) {
    const auto card = std::ranges::find_if(
        cards_, [&](const CommandCard* each) { return each->command().name == command; });
    if (card == cards_.end()) return false;
    if (!(*card)->takeFocus()) setFocus(Qt::TabFocusReason);
    QTimer::singleShot(0, *card, [this, form = *card] {  // once the forms have their places
        ensureWidgetVisible(form, 0, 0);
        QScrollBar& bar = *verticalScrollBar();  // of a high one its name
        bar.setValue(std::min(bar.value(), form->y()));
    });
    return true;
}

}  // namespace cortex::gui
