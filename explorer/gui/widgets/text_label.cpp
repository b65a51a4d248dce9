// SPDX-License-Identifier: Apache-2.0
#include "widgets/text_label.hpp"

#include "model/plain_text.hpp"

#include <QEvent>
#include <QFontMetrics>
#include <QPainter>
#include <QTextLayout>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

// Long names break anywhere. Returns the height of all lines.
double breakLines(QTextLayout& layout, Qt::Alignment alignment, int width) {
    QTextOption option{alignment};
    option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    layout.setTextOption(option);
    double height = 0;
    layout.beginLayout();
    for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
        line.setLineWidth(width);
        line.setPosition({0, height});
        height += line.height();
    }
    layout.endLayout();
    return height;
}

double heightOf(const QString& text, const QFont& font, int width) {
    QTextLayout layout{text, font};
    return breakLines(layout, Qt::AlignLeft, width);
}

}  // namespace

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

void TextLabel::explain(const QString& tip) {
    tip_ = tipText(tip);
    setToolTip(tip_);
    setAccessibleDescription(tip);
}

void TextLabel::setTextSize(TextSize size, bool strong) {
    if (size == size_ && strong == strong_) return;
    size_ = size;
    strong_ = strong;
    dress();
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

int TextLabel::heightForWidth(int width) const {
    if (!wordWrap()) return QLabel::heightForWidth(width);
    return static_cast<int>(std::ceil(heightOf(text(), font(), width)));
}

int TextLabel::heightOfLines(int count) const {
    return static_cast<int>(std::ceil(count * heightOf(QStringLiteral("X"), font(), 1000)));
}

void TextLabel::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setPen(Look::colours().*colour_);
    if (wordWrap()) {
        paintLines(painter);
        return;
    }
    const QString shown = fontMetrics().elidedText(text(), elide_, width());
    QStringList tips{shown == text() ? QString{} : tipText(text()), tip_};
    tips.removeAll({});
    setToolTip(tips.join('\n'));
    painter.drawText(rect(), static_cast<int>(alignment()) | Qt::TextSingleLine, shown);
}

bool TextLabel::fits(const QString& text) const {
    return heightOf(text, font(), width()) <= height();
}

// What has no room in all lines is cut with an ellipsis.
void TextLabel::paintLines(QPainter& painter) {
    const auto cut = [this](int length) {
        return text().left(length).trimmed() + QStringLiteral("…");
    };
    QString shown = text();
    if (!fits(shown)) {
        int most = 0;
        for (int tooLong = text().size(); tooLong - most > 1;) {  // halved, as it may be very long
            const int half = (most + tooLong) / 2;
            (fits(cut(half)) ? most : tooLong) = half;
        }
        shown = cut(most);
    }
    QTextLayout layout{shown, font()};
    const double left = height() - breakLines(layout, alignment(), width());
    const bool centred = alignment().testFlag(Qt::AlignVCenter);
    layout.draw(&painter, {0, centred ? std::max(std::floor(left / 2), 0.0) : 0});
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
