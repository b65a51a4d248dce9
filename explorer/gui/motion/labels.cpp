// SPDX-License-Identifier: Apache-2.0
#include "motion/labels.hpp"

#include <QEvent>
#include <QPainter>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr int wrapped = Qt::AlignLeft | Qt::TextWordWrap;

int heightOfLines(const QFontMetrics& metrics, int count) {
    return metrics.height() + (count - 1) * metrics.lineSpacing();
}

// As much of a text as has room, with an ellipsis where that is not all.
QString cutToFit(const QString& text, const QFontMetrics& metrics, const QSize& room) {
    const auto fits = [&](const QString& some) {
        const QRect box{0, 0, room.width(), QWIDGETSIZE_MAX};
        return metrics.boundingRect(box, wrapped, some).height() <= room.height();
    };
    const auto cut = [&](int length) { return text.left(length).trimmed() + QStringLiteral("…"); };
    if (fits(text)) return text;
    int most = 0;
    for (int tooLong = text.size(); tooLong - most > 1;) {  // halved, as it may be very long
        const int half = (most + tooLong) / 2;
        (fits(cut(half)) ? most : tooLong) = half;
    }
    return cut(most);
}

// No text changes it, and it stays free where there is none.
QSizePolicy keptPlace() {
    QSizePolicy policy{QSizePolicy::Ignored, QSizePolicy::Fixed};
    policy.setRetainSizeWhenHidden(true);
    return policy;
}

// Markup in it is text.
QString tipTextOf(const QString& text) {
    return QStringLiteral("<p>%1</p>").arg(text.toHtmlEscaped());
}

}  // namespace

Sentence::Sentence(std::optional<Tone> tone, QWidget* parent) : QLabel{parent}, tone_{tone} {
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    dress();
}

void Sentence::say(const QString& text) {
    if (text == this->text()) return;
    setText(text);
    setAccessibleName(text);
}

void Sentence::say(const QString& text, std::optional<Tone> tone) {
    if (tone != tone_) {
        tone_ = tone;
        dress();
    }
    say(text);
}

void Sentence::keepLines(int count) {
    if (count == lines_) return;
    lines_ = count;
    setSizePolicy(keptPlace());
    fit();
}

void Sentence::fit() {
    if (lines_ > 0) setFixedHeight(heightOfLines(fontMetrics(), lines_));
}

void Sentence::paintEvent(QPaintEvent* event) {
    if (lines_ == 0) {
        QLabel::paintEvent(event);
        return;
    }
    const QString shown = cutToFit(text(), fontMetrics(), size());
    setToolTip(shown == text() ? QString{} : tipTextOf(text()));
    QPainter painter{this};
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(rect(), static_cast<int>(alignment()) | Qt::TextWordWrap, shown);
}

void Sentence::changeEvent(QEvent* event) {
    QLabel::changeEvent(event);
    if (event->type() == QEvent::StyleChange) dress();
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

void Sentence::dress() {
    if (dressing_) return;
    dressing_ = true;
    QPalette colours;
    if (tone_) colours.setColor(QPalette::WindowText, textColour(*tone_));
    setPalette(colours);
    dressing_ = false;
}

Plate::Plate(QWidget* parent) : QLabel{parent} {
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    setSizePolicy(keptPlace());
    fit();
    hide();
}

void Plate::say(const QString& text) {
    if (text != this->text()) {
        setText(text);
        setAccessibleName(text);
    }
    setVisible(!text.isEmpty());
}

void Plate::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    const int edge = units(2);
    const QRect inner = rect().adjusted(edge, margin(), -edge, -margin());
    const QString shown = cutToFit(text(), fontMetrics(), inner.size());
    setToolTip(shown == text() ? QString{} : tipTextOf(text()));
    const QRect needed = painter.boundingRect(inner, wrapped, shown);
    painter.setPen(Qt::NoPen);
    painter.setBrush(palette().color(QPalette::Highlight));
    painter.drawRoundedRect(needed.adjusted(-edge, -margin(), edge, margin()) & rect(), units(1),
                            units(1));
    painter.setPen(palette().color(QPalette::HighlightedText));
    painter.drawText(inner, wrapped, shown);
}

void Plate::changeEvent(QEvent* event) {
    QLabel::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

void Plate::fit() {
    setMargin(units(1));
    setFixedHeight(heightOfLines(fontMetrics(), lines_) + 2 * margin());
}

void Plate::keepLines(int count) {
    lines_ = count;
    fit();
}

}  // namespace cortex::explorer
