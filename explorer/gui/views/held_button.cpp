// SPDX-License-Identifier: Apache-2.0
#include "views/held_button.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QCursor>
#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWidget>

namespace cortex::gui {

namespace {

// In the middle of the button, where the cursor is known to be elsewhere, as of a touch.
std::optional<QPoint> pointerAt(const QWidget& button) {
    const bool pressed = qobject_cast<const QAbstractButton*>(&button) != nullptr;
    if (!pressed || QApplication::mouseButtons() == Qt::NoButton) return std::nullopt;
    const QPoint cursor = QCursor::pos();
    if (button.rect().contains(button.mapFromGlobal(cursor))) return cursor;
    return button.mapToGlobal(button.rect().center());
}

}  // namespace

HeldButton::HeldButton(Session& session, QWidget& button, const explorer::HeldOrder& order,
                       const QString& whyNot)
    : Hold{&button}, session_{session}, button_{button}, pointer_{pointerAt(button)}, why_{whyNot} {
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
QString HeldButton::endOf(QObject* object, QEvent* event) {
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
    if (type == QEvent::Move || type == QEvent::Resize) return endOfPlace(object, event);
    return object == &button_ ? endOfButton(event) : QString{};
}

// The button moves with each widget that it lies in. Only others resize a window spontaneously.
QString HeldButton::endOfPlace(QObject* object, QEvent* event) const {
    const auto* widget = qobject_cast<QWidget*>(object);
    if (widget == nullptr || (widget != &button_ && !widget->isAncestorOf(&button_))) return {};
    if (event->type() == QEvent::Resize && widget->isWindow() && event->spontaneous()) {
        return tr("the window was resized");
    }
    const bool isLeft = pointer_ && !button_.rect().contains(button_.mapFromGlobal(*pointer_));
    return isLeft ? tr("the button moved away") : QString{};
}

QString HeldButton::endOfButton(QEvent* event) {
    switch (event->type()) {
        case QEvent::MouseButtonRelease:
            return tr("let go");
        case QEvent::KeyRelease:
            return static_cast<QKeyEvent*>(event)->isAutoRepeat() ? QString{} : tr("let go");
        case QEvent::MouseMove:
            pointer_ = static_cast<QMouseEvent*>(event)->globalPos();
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
