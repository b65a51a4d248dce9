// SPDX-License-Identifier: Apache-2.0
#include "drive/path_button.hpp"

#include "cortex/explorer/theme.hpp"

#include <QKeyEvent>
#include <QPainter>
#include <algorithm>

namespace cortex::explorer {

PathButton::PathButton(QWidget* parent) : QAbstractButton{parent} {
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    connect(this, &QAbstractButton::clicked, this, [this] { Q_EMIT opened(text()); });
}

void PathButton::show(const QString& path) {
    setVisible(!path.isEmpty());
    if (path == text()) return;
    setText(path);
    setAccessibleName(path);
    setToolTip(tr("Opens %1").arg(path));
    updateGeometry();
}

QSize PathButton::sizeHint() const {
    return {fontMetrics().horizontalAdvance(text()) + units(1),
            std::max(fontMetrics().height(), units(6))};
}

QSize PathButton::minimumSizeHint() const {
    return {std::min(sizeHint().width(), units(8)), sizeHint().height()};
}

void PathButton::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    QFont underlined = font();
    underlined.setUnderline(underMouse() || hasFocus());
    painter.setFont(underlined);
    painter.setPen(palette().color(QPalette::Link));
    painter.drawText(rect(), Qt::AlignVCenter | Qt::TextSingleLine,
                     fontMetrics().elidedText(text(), Qt::ElideMiddle, width()));
    if (!hasFocus()) return;
    painter.setPen(QPen{palette().color(QPalette::Highlight), 2});
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void PathButton::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        click();
    } else {
        QAbstractButton::keyPressEvent(event);
    }
}

}  // namespace cortex::explorer
