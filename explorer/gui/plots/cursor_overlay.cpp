// SPDX-License-Identifier: Apache-2.0
#include "plots/cursor_overlay.hpp"

#include "plots/time_ticks.hpp"
#include "style/look.hpp"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

CursorOverlay::CursorOverlay(QWidget* parent) : QWidget{parent} {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setAccessibleName(tr("Cursors"));
}

void CursorOverlay::show(const Cursors& cursors, TimeSpan span, const QRect& plot, char chosen) {
    cursors_ = cursors;
    span_ = span;
    plot_ = plot;
    chosen_ = chosen;
    setVisible(showsAny());
    if (isVisible()) update();
}

void CursorOverlay::mark(int from, int to) {
    from_ = from;
    to_ = to;
    setVisible(showsAny());
    update();
}

std::optional<double> CursorOverlay::placeOf(double at) const {
    const double x =
        std::round(plot_.left() + (at - span_.from) / span_.length() * plot_.width()) + 0.5;
    if (x < plot_.left() || x > plot_.right() + 1) return {};
    return x;
}

// A moment in words, right of a line or left of it, on a ground of its own.
void CursorOverlay::paintMoment(QPainter& painter, double x, double top, double at) const {
    const Tokens& c = Look::colours();
    const QString text = timeText(at, 1e-3);
    const QFontMetricsF metrics{Look::font(TextSize::Note)};
    const double gap = Look::length(1), wide = metrics.horizontalAdvance(text) + 2 * gap;
    const bool fits = x + gap + wide < plot_.right();
    const QRectF box{fits ? x + gap : x - gap - wide, top, wide, metrics.height() + gap / 2};
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.canvas);
    painter.drawRect(box);
    painter.setPen(c.ink);
    painter.setFont(Look::font(TextSize::Note));
    painter.drawText(box, Qt::AlignCenter, text);
}

// As thin as the grid, and its moment at the lower edge.
void CursorOverlay::paintPointer(QPainter& painter, double at) const {
    const auto x = placeOf(at);
    if (!x) return;
    painter.setPen(QPen{Look::colours().ink2, 1});
    painter.drawLine(QPointF{*x, plot_.top() + 0.0}, QPointF{*x, plot_.bottom() + 0.0});
    paintMoment(painter, *x, plot_.bottom() - Look::length(5), at);
}

void CursorOverlay::paintCursor(QPainter& painter, double at, QChar name) const {
    const Tokens& c = Look::colours();
    const auto place = placeOf(at);
    if (!place) return;
    const double x = *place;
    const bool chosen = chosen_ == name.toLatin1();
    QPen pen{chosen ? c.accent : c.ink, 1};
    pen.setDashPattern({3, 3});
    painter.setPen(pen);
    const double side = Look::length(4);
    painter.drawLine(QPointF{x, plot_.top() + side}, QPointF{x, plot_.bottom() + 0.0});
    const QRectF head{x - side / 2 - 0.5, plot_.top() + 0.0, side, side};
    painter.setPen(Qt::NoPen);
    painter.setBrush(chosen ? c.accent : c.ink);
    painter.drawRoundedRect(head, Look::length(0.5), Look::length(0.5));
    painter.setPen(chosen ? c.onAccent : c.surface);
    painter.setFont(Look::font(TextSize::Note, true));
    painter.drawText(head, Qt::AlignCenter, name);
    paintMoment(painter, x + side / 2 - Look::length(1), plot_.top(), at);
}

void CursorOverlay::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    if (from_ != to_) {
        QColor inside = Look::colours().accent;
        inside.setAlphaF(0.2);
        const QRect box{std::min(from_, to_), plot_.top(), std::abs(to_ - from_), plot_.height()};
        painter.fillRect(box, inside);
        painter.setPen(Look::colours().accent);
        painter.drawRect(box);
    }
    if (!(span_.length() > 0)) return;
    if (cursors_.pointer && from_ == to_) paintPointer(painter, *cursors_.pointer);
    if (!cursors_.shown) return;
    painter.setRenderHint(QPainter::Antialiasing);
    paintCursor(painter, cursors_.a, 'A');
    paintCursor(painter, cursors_.b, 'B');
}

}  // namespace cortex::gui
