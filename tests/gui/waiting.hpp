// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/waiting.hpp"

#include <QApplication>
#include <QLabel>
#include <QTimer>
#include <functional>
#include <string>
#include <thread>

namespace cortex::test {

// All texts that windows show now.
inline std::string shownTexts() {
    QStringList texts;
    for (const QWidget* window : QApplication::topLevelWidgets()) {
        for (const auto* each : window->findChildren<QLabel*>()) {
            if (each->isVisible() && !each->text().isEmpty()) texts << each->text();
        }
    }
    return texts.join(QStringLiteral(" | ")).toStdString();
}

inline bool comes(const std::function<bool()>& condition, const Place& place = Place::current()) {
    QTimer events;  // it ends also where nothing else is an event
    events.start(100);
    seenLast = shownTexts;
    return looksUntil(
        condition, [] { QApplication::processEvents(QEventLoop::WaitForMoreEvents); }, place);
}

// The same while the window handles no event at all.
inline bool comesWithoutEvents(const std::function<bool()>& condition,
                               const Place& place = Place::current()) {
    return looksUntil(condition, std::this_thread::yield, place);
}

}  // namespace cortex::test
