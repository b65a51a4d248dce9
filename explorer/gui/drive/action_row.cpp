// SPDX-License-Identifier: Apache-2.0
#include "drive/action_row.hpp"

#include "motion/labels.hpp"

#include <QEvent>
#include <QGridLayout>
#include <QPushButton>
#include <algorithm>
#include <stdexcept>

namespace cortex::explorer {

namespace {

struct DriveAction {
    const char *command, *title;
};
constexpr std::array<DriveAction, ActionRow::count> driveActions{
    {{"enable", QT_TRANSLATE_NOOP("cortex::explorer::ActionRow", "Enable")},
     {"disable", QT_TRANSLATE_NOOP("cortex::explorer::ActionRow", "Disable")},
     {"quickStop", QT_TRANSLATE_NOOP("cortex::explorer::ActionRow", "Quick stop")},
     {"resetFault", QT_TRANSLATE_NOOP("cortex::explorer::ActionRow", "Reset fault")}}};

}  // namespace

ActionRow::ActionRow(QWidget* parent) : QWidget{parent} {
    auto* grid = new QGridLayout{this};
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(units(1.5));
    grid->setVerticalSpacing(0);
    for (std::size_t i = 0; i < count; ++i) {
        const QString title = tr(driveActions[i].title);
        const QString command = QLatin1String{driveActions[i].command};
        buttons_[i] = new QPushButton{title};
        buttons_[i]->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        connect(buttons_[i], &QPushButton::clicked, this,
                [this, command, title] { Q_EMIT wanted(command, title); });
        reasons_[i] = new Sentence{Tone::Quiet};
        reasons_[i]->setWordWrap(false);
        reasons_[i]->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        grid->addWidget(buttons_[i], 0, static_cast<int>(i));
        grid->addWidget(reasons_[i], 1, static_cast<int>(i));
        grid->setColumnStretch(static_cast<int>(i), 1);
    }
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    fit();
}

QPushButton& ActionRow::button(const char* command) const {
    const auto found = std::ranges::find(driveActions, std::string_view{command},
                                         [](const DriveAction& each) { return each.command; });
    if (found == driveActions.end()) throw std::invalid_argument{command};
    return *buttons_[static_cast<std::size_t>(found - driveActions.begin())];
}

// All are as wide as the widest.
void ActionRow::fit() {
    if (fitting_) return;
    fitting_ = true;
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.9);
    int width = 0;
    for (const QPushButton* each : buttons_)
        width = std::max(width, each->fontMetrics().horizontalAdvance(each->text()));
    for (QPushButton* each : buttons_)
        each->setMinimumWidth(width + units(1.5)), each->setFixedHeight(units(7.5));
    for (Sentence* each : reasons_) {
        each->setFont(small);
        each->setFixedHeight(QFontMetrics{small}.height());
    }
    fitting_ = false;
}

void ActionRow::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

void ActionRow::resizeEvent(QResizeEvent* /*event*/) { place(); }

void ActionRow::show(const AxisReasons& reasons) {
    const std::array now{reasons.enable, reasons.disable, reasons.quickStop, reasons.resetFault};
    for (std::size_t i = 0; i < count; ++i) {
        buttons_[i]->setEnabled(now[i].isEmpty());
        buttons_[i]->setToolTip(now[i]);
        buttons_[i]->setAccessibleDescription(now[i]);
    }
    why_ = now;
    all_ = reasons.all;
    place();
}

// A reason that all have, or that has no room below its button, stands in a sentence.
void ActionRow::place() {
    QStringList sentences;
    if (!all_.isEmpty()) sentences << all_ + '.';
    for (std::size_t i = 0; i < count; ++i) {
        const QString why = why_[i] == all_ ? QString{} : why_[i];
        const bool fits = reasons_[i]->fontMetrics().horizontalAdvance(why) <= buttons_[i]->width();
        reasons_[i]->say(fits ? why : QString{});
        if (!fits) sentences << tr("%1: %2.").arg(buttons_[i]->text(), why);
    }
    long_ = sentences.join(' ');
}

}  // namespace cortex::explorer
