// SPDX-License-Identifier: Apache-2.0
#include "views/held_button.hpp"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWidget>

namespace cortex::gui {

HeldButton::HeldButton(Session& session, QWidget& button, const explorer::HeldOrder& order,
                       const QString& whyNot)
    : Hold{&button}, session_{session}, button_{button}, why_{whyNot} {
    if (!runs()) return;
    HeldCommand command{order.order.path, order.order.command, order.order.arguments, {},
                        order.every,      order.order.budget};
    if (order.atEnd) command.atEnd = *order.atEnd;
    number_ = session_.hold(std::move(command));
    QApplication::instance()->installEventFilter(this);
}

HeldButton::~HeldButton() {
    if (runs()) session_.endHold(number_);
}

void HeldButton::change(const explorer::Arguments& arguments) {
    if (runs()) session_.changeHold(number_, arguments);
}

void HeldButton::end() { stop(tr("let go")); }

void HeldButton::finish(const QString& why) {
    if (!runs()) return;
    why_ = why;
    QApplication::instance()->removeEventFilter(this);
    Q_EMIT ended();
}

void HeldButton::stop(const QString& why) {
    if (!runs()) return;
    session_.endHold(number_);
    finish(why);
}

bool HeldButton::eventFilter(QObject* object, QEvent* event) {
    const QString why = endOf(object, event);
    if (!why.isEmpty()) stop(why);
    return false;
}

// Why this event ends it; empty: it does not. Events of the button's own window reach its widgets.
QString HeldButton::endOf(QObject* object, QEvent* event) const {
    const QEvent::Type type = event->type();
    if (type == QEvent::ApplicationStateChange &&
        static_cast<QApplicationStateChangeEvent*>(event)->applicationState() !=
            Qt::ApplicationActive) {
        return tr("focus left the program");
    }
    // At its widget a key is known to be held or not, at its window it is not yet.
    if (type == QEvent::KeyPress && object->isWidgetType() &&
        !static_cast<QKeyEvent*>(event)->isAutoRepeat()) {
        const bool escape = static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape;
        return escape ? tr("Esc") : tr("another key was pressed");
    }
    if (type == QEvent::MouseButtonPress && object->isWidgetType()) {
        return tr("another button was pressed");
    }
    if (type == QEvent::Show && object->isWidgetType() &&
        static_cast<QWidget*>(object)->windowType() == Qt::Popup) {
        return tr("focus left");
    }
    if (object != &button_) return {};
    switch (type) {
        case QEvent::MouseButtonRelease:
            return tr("let go");
        case QEvent::KeyRelease:
            return static_cast<QKeyEvent*>(event)->isAutoRepeat() ? QString{} : tr("let go");
        case QEvent::MouseMove:
            return button_.rect().contains(static_cast<QMouseEvent*>(event)->pos())
                       ? QString{}
                       : tr("the pointer left the button");
        case QEvent::FocusOut:
        case QEvent::WindowDeactivate:
        case QEvent::WindowBlocked:
            return tr("focus left");
        case QEvent::Hide:
            return tr("the button is gone");
        case QEvent::EnabledChange:
            return button_.isEnabled() ? QString{} : tr("it is not allowed any more");
        default:
            return {};
    }
}

}  // namespace cortex::gui
