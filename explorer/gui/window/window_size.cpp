// SPDX-License-Identifier: Apache-2.0
#include "window/window_size.hpp"

#include <QScreen>
#include <QWidget>

namespace cortex::gui {

namespace {

QString sizeField(const char* name) { return QLatin1String{name}; }

}  // namespace

QJsonObject savedSize(const QWidget& window) {
    const bool isLarger = window.isMaximized() || window.isFullScreen();
    const QSize size = isLarger && window.normalGeometry().isValid()
                           ? window.normalGeometry().size()
                           : window.size();
    return {{sizeField("width"), size.width()},
            {sizeField("height"), size.height()},
            {sizeField("maximised"), window.isMaximized()}};
}

void fitToScreen(QWidget& window) {
    const QSize most = window.screen()->availableSize();
    window.resize(window.size().boundedTo(most).expandedTo(window.minimumSize()));
}

void restoreSize(QWidget& window, const QJsonObject& saved) {
    if (saved.isEmpty()) return;
    const QSize wanted{saved[sizeField("width")].toInt(), saved[sizeField("height")].toInt()};
    const QSize most = window.screen()->availableSize();
    Qt::WindowStates states = window.windowState();
    states.setFlag(Qt::WindowMaximized, saved[sizeField("maximised")].toBool());
    if (states != window.windowState()) window.setWindowState(states);
    if (!window.isMaximized() || !window.isVisible())
        window.resize(wanted.boundedTo(most).expandedTo(window.minimumSize()));
}

}  // namespace cortex::gui
