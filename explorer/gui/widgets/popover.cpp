// SPDX-License-Identifier: Apache-2.0
#include "widgets/popover.hpp"

#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QCloseEvent>
#include <QPainter>
#include <QVBoxLayout>

namespace cortex::gui {

Popover::Popover(const QString& title, QWidget* parent)
    : QFrame{parent, Qt::Popup}, rows_{new QVBoxLayout{this}} {
    setAttribute(Qt::WA_DeleteOnClose);
    rows_->setContentsMargins(Look::units(5), Look::units(4), Look::units(5), Look::units(4));
    auto* label = new TextLabel{TextSize::Value, true};
    label->show(title);
    rows_->addWidget(label);
    setAccessibleName(title);
}

void Popover::closeEvent(QCloseEvent* event) {
    QFrame::closeEvent(event);
    Q_EMIT closed();
}

void Popover::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().raised);
    painter.setPen(QPen{Look::colours().border, static_cast<double>(Look::lineWidth())});
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

}  // namespace cortex::gui
