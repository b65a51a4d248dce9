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

// Three digits, then five, then nine: it seldom changes.
QString roomFor(const QString& count) {
    constexpr int few = 3, many = 6;  // characters
    return count.size() <= few    ? QStringLiteral("000")
           : count.size() <= many ? QStringLiteral("00,000")
                                  : QStringLiteral("000,000,000");
}

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

void Chip::show(std::uint64_t count, bool grows) {
    const QString text = countText(count), room = grows ? roomFor(text) : room_;
    if (text == count_ && room == room_) return;
    count_ = text;
    room_ = room;
    tell();
}

void Chip::explain(const QString& meaning) {
    meaning_ = meaning;
    setAccessibleDescription(meaning);
    tell();
}

QString Chip::rest(const QString& count) const {
    return isChecked() ? ' ' + count : tr(" %1 hidden").arg(count);
}

void Chip::tell() {
    setAccessibleName(word_ + rest(count_));
    const QString act = isChecked() ? tr("Hides these") : tr("Shows these");
    setToolTip(meaning_.isEmpty() ? act : tipText(meaning_ + '\n' + act));
    updateGeometry();
    update();
}

QSize Chip::sizeHint() const {
    const QFontMetrics metrics{fontOf(false)};
    return {
        metrics.horizontalAdvance(word_ + rest(room_)) + (mark_ ? markWidth() : 0) + Look::units(4),
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
    painter.drawText(box, Qt::AlignVCenter, rest(count_));
}

}  // namespace cortex::gui
