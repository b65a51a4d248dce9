// SPDX-License-Identifier: Apache-2.0
#include "widgets/text_label.hpp"

#include "model/plain_text.hpp"

#include <QEvent>
#include <QFontMetrics>
#include <QPainter>
#include <QTextOption>

namespace cortex::gui {

TextLabel::TextLabel(TextSize size, bool strong, QColor Tokens::* colour, QWidget* parent)
    : QLabel{parent}, size_{size}, strong_{strong}, colour_{colour} {
    setTextFormat(Qt::PlainText);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    dress();
}

void TextLabel::show(const QString& text) {
    if (text == this->text()) return;
    setText(text);
    setAccessibleName(text);
    updateGeometry();
}

void TextLabel::show(const QString& text, QColor Tokens::* colour) {
    if (colour != colour_) {
        colour_ = colour;
        update();
    }
    show(text);
}

QSize TextLabel::sizeHint() const {
    if (wordWrap()) return QLabel::sizeHint();
    const QFontMetrics metrics{font()};
    return {metrics.horizontalAdvance(text()) + 2, metrics.height()};
}

QSize TextLabel::minimumSizeHint() const {
    if (wordWrap()) return QLabel::minimumSizeHint();
    if (whole_) return sizeHint();
    const QFontMetrics metrics{font()};
    return {std::min(metrics.horizontalAdvance(text()) + 2, Look::units(8)), metrics.height()};
}

void TextLabel::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setPen(Look::colours().*colour_);
    if (wordWrap()) {
        paintLines(painter);
        return;
    }
    const QString shown = fontMetrics().elidedText(text(), Qt::ElideRight, width());
    setToolTip(shown == text() ? QString{} : tipText(text()));
    painter.drawText(rect(), static_cast<int>(alignment()) | Qt::TextSingleLine, shown);
}

// Long names break anywhere; what has no room in all lines is cut with an ellipsis.
void TextLabel::paintLines(QPainter& painter) {
    QTextOption lines{alignment()};
    lines.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    const auto fits = [&](const QString& shown) {
        return painter.boundingRect(QRectF{rect()}, shown, lines).height() <= height() + 1;
    };
    if (fits(text())) {
        painter.drawText(QRectF{rect()}, text(), lines);
        return;
    }
    const auto cut = [this](int length) {
        return text().left(length).trimmed() + QStringLiteral("…");
    };
    int shown = 0;
    for (int tooLong = text().size(); tooLong - shown > 1;) {  // halved, as texts may be very long
        const int half = (shown + tooLong) / 2;
        (fits(cut(half)) ? shown : tooLong) = half;
    }
    painter.drawText(QRectF{rect()}, cut(shown), lines);
}

void TextLabel::changeEvent(QEvent* event) {
    QLabel::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::ApplicationFontChange) {
        dress();
    }
}

void TextLabel::dress() {
    if (dressing_) return;
    dressing_ = true;
    setFont(Look::font(size_, strong_));
    updateGeometry();
    dressing_ = false;
}

}  // namespace cortex::gui
