// SPDX-License-Identifier: Apache-2.0
#include "plots/cursor_overlay.hpp"

#include "plots/time_ticks.hpp"
#include "style/look.hpp"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

int bandRow() {
    return std::max(Look::units(4.5), QFontMetrics{Look::font(TextSize::Note)}.height());
}

}  // namespace

QString cursorName(QChar name, double at, TimeSpan shown) {
    if (at < shown.from) return QStringLiteral("← ") + name;
    return at > shown.to ? name + QStringLiteral(" →") : QString{name};
}

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
    const QString text = texts().join(QStringLiteral("; "));
    if (text != accessibleDescription()) setAccessibleDescription(text);
    if (isVisible()) update();
}

int CursorOverlay::bandHeight() { return 2 * bandRow(); }

QStringList CursorOverlay::texts() const {
    if (!cursors_.shown || !(span_.length() > 0)) return {};
    return {QStringLiteral("A ") + momentOf(cursors_.a),
            QStringLiteral("B ") + momentOf(cursors_.b)};
}

// "12:15:06.200", or that it is out of view: in words where they have room.
QString CursorOverlay::momentOf(double at) const {
    QString time = timeText(at, 1e-3);
    if (placeOf(at)) return time;
    const QString words = tr("%1, out of view").arg(time);
    const QFontMetricsF metrics{Look::font(TextSize::Note)};
    const bool fits = metrics.horizontalAdvance(words) + Look::length(12) < plot_.width();
    const QString& text = fits ? words : time;
    return at < span_.from ? QStringLiteral("← ") + text : text + QStringLiteral(" →");
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
void CursorOverlay::paintMoment(QPainter& painter, double x, double clear, double top,
                                const QString& text) const {
    const Tokens& c = Look::colours();
    const QFontMetricsF metrics{Look::font(TextSize::Note)};
    const double gap = Look::length(1), wide = metrics.horizontalAdvance(text) + 2 * gap;
    const bool fits = x + clear + wide < plot_.right();
    const double left = fits ? x + clear : std::max(x - clear - wide, 0.0);
    const QRectF box{left, top, wide, static_cast<double>(bandRow())};
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.canvas);
    painter.drawRect(box);
    painter.setPen(c.ink);
    painter.setFont(Look::font(TextSize::Note));
    painter.drawText(box, Qt::AlignCenter, text);
}

// As thin as the grid, and its moment on the axis of time.
void CursorOverlay::paintPointer(QPainter& painter, double at) const {
    const auto x = placeOf(at);
    if (!x) return;
    painter.setPen(QPen{Look::colours().ink2, 1});
    painter.drawLine(QPointF{*x, plot_.top() + 0.0}, QPointF{*x, plot_.bottom() + 0.0});
    paintMoment(painter, *x, Look::length(1), plot_.bottom() + 1.0, timeText(at, 1e-3));
}

// Its name and its moment are in a row of its own: A above B. Out of view they stand at the edge.
void CursorOverlay::paintCursor(QPainter& painter, double at, QChar name) const {
    const Tokens& c = Look::colours();
    const double side = Look::length(4), row = bandRow();
    const double top = plot_.top() + (name == 'A' ? 0 : row);
    const auto place = placeOf(at);
    const double edge = at < span_.from ? plot_.left() + side / 2 : plot_.right() - side / 2;
    const double x = place.value_or(std::round(edge) + 0.5);
    const QColor colour = chosen_ == name.toLatin1() ? c.accent : c.ink;
    QPen pen{colour, 1};
    pen.setDashPattern({3, 3});
    painter.setPen(pen);
    if (place) painter.drawLine(QPointF{x, top + side}, QPointF{x, plot_.bottom() + 0.0});
    paintMoment(painter, x, side / 2, top, momentOf(at));
    const QRectF head{x - side / 2 - 0.5, top + (row - side) / 2, side, side};
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawRoundedRect(head, Look::length(0.5), Look::length(0.5));
    painter.setPen(chosen_ == name.toLatin1() ? c.onAccent : c.surface);
    painter.setFont(Look::font(TextSize::Note, true));
    painter.drawText(head, Qt::AlignCenter, name);
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
