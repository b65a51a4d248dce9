// SPDX-License-Identifier: Apache-2.0
#include "widgets/chip.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"

#include <QFontMetrics>
#include <QPainter>

namespace cortex::gui {

namespace {

QFont fontOf(bool struck) {
    QFont font = Look::font(TextSize::Note);
    font.setStrikeOut(struck);
    return font;
}

int markWidth() { return Look::units(5); }

}  // namespace

Chip::Chip(const QString& word, std::optional<Shape> mark, QWidget* parent)
    : QAbstractButton{parent}, word_{word}, mark_{mark} {
    setCheckable(true);
    setChecked(true);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    connect(this, &QAbstractButton::toggled, this, &Chip::tell);
    tell();
}

void Chip::show(std::uint64_t count) {
    const QString text = countText(count);
    if (text == count_) return;
    count_ = text;
    tell();
}

QString Chip::rest() const { return isChecked() ? ' ' + count_ : tr(" %1 hidden").arg(count_); }

void Chip::tell() {
    setAccessibleName(word_ + rest());
    setToolTip(isChecked() ? tr("Hides these") : tr("Shows these"));
    updateGeometry();
    update();
}

QSize Chip::sizeHint() const {
    const QFontMetrics metrics{fontOf(false)};
    return {metrics.horizontalAdvance(word_ + rest()) + (mark_ ? markWidth() : 0) + Look::units(4),
            Look::units(7)};
}

void Chip::paintEvent(QPaintEvent* /*event*/) {
    const Tokens& c = Look::colours();
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    const double width = hasFocus() ? 2 : Look::lineWidth();
    painter.setPen(QPen{hasFocus() ? c.accent : isChecked() ? c.border : c.line, width});
    painter.setBrush(!isChecked() ? c.surface : underMouse() ? c.hover : c.raised);
    const double half = width / 2;
    painter.drawRoundedRect(QRectF{rect()}.adjusted(half, half, -half, -half), Look::units(1),
                            Look::units(1));
    QRect box = rect().adjusted(Look::units(2), 0, 0, 0);
    if (mark_) {
        const int size = Look::units(3.5);
        gui::paint(painter, QRectF(box.left(), (height() - size) / 2.0, size, size), *mark_, c);
        box.setLeft(box.left() + markWidth());
    }
    painter.setPen(isChecked() ? c.ink : c.ink2);
    painter.setFont(fontOf(!isChecked()));
    painter.drawText(box, Qt::AlignVCenter, word_);
    box.setLeft(box.left() + painter.fontMetrics().horizontalAdvance(word_));
    painter.setFont(fontOf(false));
    painter.drawText(box, Qt::AlignVCenter, rest());
}

}  // namespace cortex::gui
