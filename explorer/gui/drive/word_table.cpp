// SPDX-License-Identifier: Apache-2.0
#include "drive/word_table.hpp"

#include "cortex/explorer/theme.hpp"

#include "drive/mark.hpp"

#include <QEvent>
#include <QFontMetrics>
#include <QPainter>
#include <algorithm>

namespace cortex::explorer {

namespace {

QString wordOrNothing(const ShownWord& word) {
    if (!word.word) return QStringLiteral("—");
    const QString text = wordText(*word.word);
    return word.live ? text : '[' + text + ']';
}

QString inWords(const ShownWord& word) {
    QStringList set;
    for (const NamedBit& each : word.bits) {
        if ((word.word.value_or(0) & each.mask) != 0) set << each.name;
    }
    return WordTable::tr("%1 %2: %3")
        .arg(word.title, wordOrNothing(word),
             set.isEmpty() ? WordTable::tr("none") : set.join(QStringLiteral(", ")));
}

// All modes are asked, so that nothing moves when another one is chosen.
int widestBit(const QFontMetrics& metrics) {
    int width = 0;
    for (int mode = 0; mode <= 10; ++mode) {
        for (const auto& bits : {statusBits(mode), controlBits(mode)}) {
            for (const NamedBit& each : bits)
                width = std::max(width, metrics.horizontalAdvance(each.name));
        }
    }
    return width;
}

}  // namespace

WordTable::WordTable(QWidget* parent) : QWidget{parent} {
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    setAccessibleName(tr("Status word and control word"));
}

void WordTable::show(const ShownWord& status, const ShownWord& control) {
    if (words_[0] == status && words_[1] == control) return;
    words_ = {status, control};
    setAccessibleDescription(inWords(status) + QStringLiteral(". ") + inWords(control));
    update();
}

QFont WordTable::noteFont() const {
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.9);
    return small;
}

int WordTable::rowHeight() const { return QFontMetrics{noteFont()}.height(); }

int WordTable::columnWidth() const {
    const QFontMetrics metrics{noteFont()};
    QFont strong = noteFont();
    strong.setWeight(QFont::DemiBold);
    int title = 0;
    for (const ShownWord& each : words_)
        title = std::max(title, metrics.horizontalAdvance(each.title + ' '));
    title += QFontMetrics{strong}.horizontalAdvance(QStringLiteral("[0x0000]"));
    return std::max(title, widestBit(metrics) + units(4.5));
}

QSize WordTable::sizeHint() const { return minimumSizeHint(); }

QSize WordTable::minimumSizeHint() const {
    return {2 * columnWidth() + units(2.5), 8 * rowHeight() + units(1)};
}

void WordTable::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        updateGeometry();
}

void WordTable::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    const int wide = std::min((width() - units(2.5)) / 2, columnWidth() + units(8));
    paintWord(painter, words_[0], {0, 0, wide, height()});
    paintWord(painter, words_[1], {wide + units(2.5), 0, wide, height()});
}

void WordTable::paintWord(QPainter& painter, const ShownWord& word, const QRect& box) const {
    QFont strong = noteFont();
    strong.setWeight(QFont::DemiBold);
    const int row = rowHeight();
    const QRect title{box.left(), 0, box.width(), row};
    painter.setFont(noteFont());
    painter.setPen(textColour(Tone::Quiet));
    painter.drawText(title, Qt::AlignLeft | Qt::AlignVCenter, word.title);
    painter.setFont(strong);
    painter.setPen(word.live ? palette().color(QPalette::WindowText) : textColour(Tone::NotLive));
    painter.drawText(title, Qt::AlignRight | Qt::AlignVCenter, wordOrNothing(word));
    painter.fillRect(QRect{box.left(), row, box.width(), 1}, palette().color(QPalette::Mid));
    int top = row + units(0.75);
    for (const NamedBit& each : word.bits) {
        paintBit(painter, word, each, {box.left(), top, box.width(), row});
        top += row;
    }
}

void WordTable::paintBit(QPainter& painter, const ShownWord& word, const NamedBit& bit,
                         const QRect& box) const {
    const bool set = word.live && (word.word.value_or(0) & bit.mask) != 0;
    const double size = units(2.5);
    const QRectF mark{box.left() * 1.0, box.top() + (box.height() - size) / 2.0, size, size};
    const MarkShape shape = !word.live                     ? MarkShape::DashedRing
                            : !set                         ? MarkShape::Ring
                            : bit.kind == BitKind::Warning ? MarkShape::Triangle
                            : bit.kind == BitKind::Error   ? MarkShape::Octagon
                                                           : MarkShape::Disc;
    paintMark(painter, mark, shape, palette());
    const bool strong = set && bit.kind != BitKind::Plain;
    QFont font = noteFont();
    if (strong) font.setWeight(QFont::DemiBold);
    painter.setFont(font);
    painter.setPen(!word.live ? textColour(Tone::NotLive)
                   : set      ? palette().color(QPalette::WindowText)
                              : textColour(Tone::Quiet));
    painter.drawText(box.adjusted(units(4), 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, bit.name);
}

}  // namespace cortex::explorer
