// SPDX-License-Identifier: Apache-2.0
#include "program/key_repeat.hpp"

#include <QCoreApplication>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int longestWait = 25;  // ms

QKeyEvent copyOf(const QKeyEvent& event, bool repeats) {
    QKeyEvent copy{event.type(),
                   event.key(),
                   event.modifiers(),
                   event.nativeScanCode(),
                   event.nativeVirtualKey(),
                   event.nativeModifiers(),
                   event.text(),
                   repeats,
                   static_cast<ushort>(event.count())};
    copy.setTimestamp(event.timestamp());
    return copy;
}

// What must not come before a release that waits.
bool changesFocus(QEvent::Type type) {
    return type == QEvent::FocusOut || type == QEvent::FocusIn ||
           type == QEvent::MouseButtonPress || type == QEvent::Close;
}

}  // namespace

KeyRepeat::KeyRepeat(QObject& application) {
    timer_.setSingleShot(true);
    timer_.setInterval(longestWait);
    QObject::connect(&timer_, &QTimer::timeout, this, &KeyRepeat::letGo);
    application.installEventFilter(this);
}

bool KeyRepeat::eventFilter(QObject* object, QEvent* event) {
    if (sends_ || !object->isWindowType()) return false;
    const QEvent::Type type = event->type();
    if (type == QEvent::KeyPress || type == QEvent::KeyRelease)
        return filterKey(*static_cast<QWindow*>(object), *static_cast<QKeyEvent*>(event));
    if (changesFocus(type)) letGo();
    return false;
}

bool KeyRepeat::filterKey(QWindow& window, const QKeyEvent& event) {
    const bool pair = release_ && event.type() == QEvent::KeyPress && window_ == &window &&
                      release_->key() == event.key() && release_->timestamp() == event.timestamp();
    if (pair && event.timestamp() != 0) {
        release_.reset();
        timer_.stop();
        QKeyEvent press = copyOf(event, true);
        sends_ = true;
        QCoreApplication::sendEvent(&window, &press);
        sends_ = false;
        return true;
    }
    letGo();
    if (event.type() == QEvent::KeyPress || event.isAutoRepeat()) return false;
    window_ = &window;
    release_ = copyOf(event, false);
    timer_.start();
    return true;
}

void KeyRepeat::letGo() {
    timer_.stop();
    auto release = std::exchange(release_, std::nullopt);
    if (!release || !window_) return;
    sends_ = true;
    QCoreApplication::sendEvent(window_, &*release);
    sends_ = false;
}

}  // namespace cortex::gui
