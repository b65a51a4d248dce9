// SPDX-License-Identifier: Apache-2.0
#include "motion/labels.hpp"

#include <QEvent>
#include <QPainter>
#include <algorithm>

namespace cortex::explorer {

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

void Sentence::changeEvent(QEvent* event) {
    QLabel::changeEvent(event);
    if (event->type() == QEvent::StyleChange) dress();
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
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
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
    const QRect inner = rect().adjusted(edge, 0, -edge, 0);
    const QRect needed =
        painter.boundingRect(inner, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap, text());
    painter.setPen(Qt::NoPen);
    painter.setBrush(palette().color(QPalette::Highlight));
    painter.drawRoundedRect(QRect{0, 0, std::min(needed.width() + 2 * edge, width()), height()},
                            units(1), units(1));
    painter.setPen(palette().color(QPalette::HighlightedText));
    painter.drawText(inner, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap, text());
}

void Plate::changeEvent(QEvent* event) {
    QLabel::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) fit();
}

void Plate::fit() {
    setMargin(units(1));
    setMinimumHeight(fontMetrics().height() + 2 * margin());
}

void Plate::keepPlace(bool keeps) {
    QSizePolicy policy = sizePolicy();
    if (policy.retainSizeWhenHidden() == keeps) return;
    policy.setRetainSizeWhenHidden(keeps);
    setSizePolicy(policy);
}

}  // namespace cortex::explorer
