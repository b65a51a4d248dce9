// SPDX-License-Identifier: Apache-2.0
#include "widgets/question.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QFontMetrics>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPushButton>
#include <QScreen>
#include <QVBoxLayout>
#include <algorithm>

namespace cortex::gui {

namespace {

constexpr double narrowestQuestion = 70, widestQuestion = 120;  // units
constexpr int mostTitleLines = 3, reasonLines = 2;

// As wide as its longest line, within bounds.
int widthOf(const Question::Words& words) {
    const QFontMetrics strong{Look::font(TextSize::Value, true)}, usual{Look::font()};
    int width = std::max(Look::units(narrowestQuestion), strong.horizontalAdvance(words.title));
    for (const QString& each : words.lines)
        width = std::max(width, usual.horizontalAdvance(each.left(1000)));
    const int screen = QGuiApplication::primaryScreen()->availableSize().width();
    return std::min({width + 2, Look::units(widestQuestion), screen * 3 / 4});
}

}  // namespace

Question::Question(const Words& words, QWidget* asker)
    : Popover{words.title, asker},
      asker_{asker},
      yes_{new QPushButton{QString{words.yes}.replace('&', QStringLiteral("&&"))}},
      no_{new QPushButton{words.no}},
      reason_{new TextLabel{TextSize::Note, false, &Tokens::warnText}} {
    const int width = widthOf(words);
    title().setWordWrap(true);
    title().setToolTip(tipText(words.title));
    title().setFixedSize(
        width, std::min(title().heightForWidth(width), title().heightOfLines(mostTitleLines)));
    for (const QString& each : words.lines) {
        auto* line = new TextLabel;
        line->setWordWrap(true);
        line->show(each);
        line->setFixedSize(width, line->heightForWidth(width));
        rows().addWidget(line);
    }
    rows().addStretch(1);
    reason_->setWordWrap(true);
    reason_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    reason_->setFixedHeight(reason_->heightOfLines(reasonLines));
    static_cast<QVBoxLayout*>(layout())->insertWidget(layout()->count() - 1, reason_);
    buttons().addWidget(yes_);
    buttons().addWidget(no_);
    no_->setToolTip(tr("Esc"));
    connect(yes_, &QPushButton::clicked, this, &Question::pressed);
    connect(no_, &QPushButton::clicked, this, &QWidget::close);
    asker_->installEventFilter(this);
    no_->setFocus();
}

// A button that has the keyboard gives it away before it is off.
void Question::refuse(const QString& why) {
    reason_->show(why);
    reason_->setToolTip(tipText(why));
    if (!why.isEmpty() && yes_->hasFocus()) no_->setFocus();
    yes_->setEnabled(why.isEmpty());
}

bool Question::eventFilter(QObject* object, QEvent* event) {
    if (object == asker_ && event->type() == QEvent::Hide) close();
    return Popover::eventFilter(object, event);
}

// Enter presses the button that has the keyboard, once: a key that is held down presses nothing.
void Question::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (!enter) return Popover::keyPressEvent(event);
    if (event->isAutoRepeat() || (event->modifiers() & ~Qt::KeypadModifier) != 0) return;
    if (auto* button = qobject_cast<QPushButton*>(focusWidget())) button->click();
}

}  // namespace cortex::gui
