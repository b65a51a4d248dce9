// SPDX-License-Identifier: Apache-2.0
#include "widgets/entry_hint.hpp"

#include "style/look.hpp"

#include <QEvent>
#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace cortex::gui {

EntryHint::EntryHint(QLineEdit& field) : QWidget{field.parentWidget()}, field_{&field} {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    hide();
    field.installEventFilter(this);
    field.parentWidget()->installEventFilter(this);
    connect(&field, &QObject::destroyed, this, &QObject::deleteLater);
}

void EntryHint::say(const QString& why) {
    text_ = why;
    field_->setAccessibleDescription(why);
    setVisible(!why.isEmpty());
    place();
    update();
}

void EntryHint::place() {
    if (!field_ || text_.isEmpty()) return;
    const QWidget& around = *parentWidget();
    const QFontMetrics metrics{Look::font(), this};
    const int width = std::min(metrics.horizontalAdvance(text_) + Look::units(5), around.width());
    const int height = std::max(metrics.height(), Look::units(5)) + Look::units(1);
    const QRect field = field_->geometry();
    const bool below = field.bottom() + height < around.height();
    setGeometry(std::clamp(field.left(), 0, around.width() - width),
                below ? field.bottom() + 1 : field.top() - height, width, height);
    raise();
}

bool EntryHint::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    if (type == QEvent::Resize || type == QEvent::Move) place();
    if (watched == field_ && type == QEvent::Hide) hide();
    return QWidget::eventFilter(watched, event);
}

void EntryHint::paintEvent(QPaintEvent* /*event*/) {
    const Tokens& c = Look::colours();
    QPainter painter{this};
    painter.setBrush(c.warnBg);
    painter.setPen(c.warnEdge);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
    painter.setFont(Look::font());
    painter.setPen(c.warnText);
    const QRect box = rect().adjusted(Look::units(2), 0, -Look::units(2), 0);
    painter.drawText(box, Qt::AlignVCenter | Qt::TextSingleLine,
                     painter.fontMetrics().elidedText(text_, Qt::ElideRight, box.width()));
}

}  // namespace cortex::gui
