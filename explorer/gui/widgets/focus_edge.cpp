// SPDX-License-Identifier: Apache-2.0
#include "widgets/focus_edge.hpp"

#include "style/look.hpp"

#include <QAbstractScrollArea>
#include <QApplication>
#include <QEvent>
#include <QPainter>

namespace cortex::gui {

FocusEdge::FocusEdge(QWidget* window) : QWidget{window} {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::NoFocus);
    hide();
    connect(qApp, &QApplication::focusChanged, this,
            [this](QWidget*, QWidget* now) { moveTo(now); });
}

void FocusEdge::moveTo(QWidget* focused) {
    if (around_) around_->removeEventFilter(this);
    const bool wanted = focused != nullptr && focused->window() == window() &&
                        (qobject_cast<QAbstractScrollArea*>(focused) != nullptr ||
                         focused->property(wantsFocusEdge).toBool());
    around_ = wanted ? focused : nullptr;
    if (around_) around_->installEventFilter(this);
    fit();
}

void FocusEdge::fit() {
    setVisible(around_ && around_->isVisible());
    if (!around_) return;
    const QRect place{around_->mapTo(parentWidget(), QPoint{}), around_->size()};
    if (place == geometry()) return;
    setGeometry(place);
    raise();
}

bool FocusEdge::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    if (type == QEvent::Resize || type == QEvent::Move || type == QEvent::Show ||
        type == QEvent::Hide)
        fit();
    return QWidget::eventFilter(watched, event);
}

void FocusEdge::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setPen(QPen{Look::colours().accent, 2.0});
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

}  // namespace cortex::gui
