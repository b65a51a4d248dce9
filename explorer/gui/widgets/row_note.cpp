// SPDX-License-Identifier: Apache-2.0
#include "widgets/row_note.hpp"

#include "widgets/text_label.hpp"

#include <QAbstractScrollArea>
#include <QEvent>
#include <QPainter>

namespace cortex::gui {

RowNote::RowNote(QAbstractScrollArea& rows)
    : QWidget{&rows},
      rows_{rows},
      text_{new TextLabel{TextSize::Note, false, &Tokens::warnText, this}} {
    text_->setWordWrap(true);
    rows.viewport()->installEventFilter(this);
    hide();
}

void RowNote::show(const QString& text) {
    text_->show(text);
    setVisible(!text.isEmpty());
    fit();
}

void RowNote::fit() {
    if (isHidden()) return;
    const QRect rows = rows_.viewport()->geometry();
    const int side = Look::units(3), above = Look::units(1);
    const int width = rows.width() - 2 * side, height = text_->heightForWidth(width);
    const int whole = height + 2 * above;
    setGeometry(rows.left(), rows.bottom() + 1 - whole, rows.width(), whole);
    text_->setGeometry(side, above, width, height);
    raise();
}

bool RowNote::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize || event->type() == QEvent::Move) fit();
    return QWidget::eventFilter(watched, event);
}

void RowNote::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().warnBg);
    painter.fillRect(QRect{0, 0, width(), Look::lineWidth()}, Look::colours().warnEdge);
}

}  // namespace cortex::gui
