// SPDX-License-Identifier: Apache-2.0
#include "drive/axis_numbers.hpp"

#include "cortex/explorer/theme.hpp"

#include <QEvent>
#include <QFontMetrics>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::explorer {

namespace {

constexpr double leastBar = 12, mostBar = 45;  // units

QString titleOf(const ShownDriveNumber& number) {
    const QString name = AxisNumbers::tr(number.number.item.c_str());
    const QString unit = number.shown.unit.text;
    return unit.isEmpty() ? name : AxisNumbers::tr("%1 (%2)").arg(name, unit);
}

QString numberOrLast(const ShownDriveNumber& each, std::optional<double> number, bool live) {
    const QString text = each.shown.text(number);
    return number && !live ? '[' + text + ']' : text;
}

}  // namespace

AxisNumbers::AxisNumbers(QWidget* parent) : QWidget{parent} {
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    setAccessibleName(tr("Position, velocity and effort"));
}

void AxisNumbers::show(const std::array<ShownDriveNumber, 3>& numbers, bool live, bool told) {
    numbers_ = numbers;
    live_ = live;
    told_ = told;
    QStringList words;
    for (const ShownDriveNumber& each : numbers_) {
        words << tr("%1 %2, wished %3")
                     .arg(titleOf(each), numberOrLast(each, each.number.now, live_),
                          numberOrLast(each, each.number.wished, told_));
    }
    const QString all = words.join(QStringLiteral("; "));
    if (all == accessibleDescription()) return;
    setAccessibleDescription(all);
    update();
}

QFont AxisNumbers::noteFont() const {
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.9);
    return small;
}

int AxisNumbers::rowHeight() const { return QFontMetrics{font()}.height(); }

int AxisNumbers::nameWidth() const {
    const QFontMetrics metrics{noteFont()};
    int width = metrics.horizontalAdvance(tr("velocity") + QStringLiteral(" (mm/s)"));
    for (const ShownDriveNumber& each : numbers_)
        width = std::max(width, metrics.horizontalAdvance(titleOf(each)));
    return width + units(1);
}

int AxisNumbers::numberWidth() const {
    return QFontMetrics{font()}.horizontalAdvance(QStringLiteral("[−888.888]")) + units(0.5);
}

QSize AxisNumbers::sizeHint() const { return minimumSizeHint(); }

QSize AxisNumbers::minimumSizeHint() const {
    return {nameWidth() + 2 * numberWidth() + units(1), 4 * rowHeight()};
}

void AxisNumbers::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        updateGeometry();
}

// The bar takes what is left, and is left out where that is too little.
AxisNumbers::Columns AxisNumbers::columns(int row) const {
    const int top = row * rowHeight(), high = rowHeight();
    const int name = nameWidth(), number = numberWidth();
    int bar = width() - name - 2 * number - units(2);
    if (bar < units(leastBar)) bar = 0;
    bar = std::min(bar, units(mostBar));
    const int end = std::min(width(), name + bar + 2 * number + units(2));
    return {{0, top, name, high},
            {name, top, bar, high},
            {end - 2 * number - units(1), top, number, high},
            {end - number, top, number, high}};
}

void AxisNumbers::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    const auto right = Qt::AlignRight | Qt::AlignVCenter | Qt::TextSingleLine;
    const auto left = Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine;
    painter.setFont(noteFont());
    painter.setPen(textColour(Tone::Quiet));
    painter.drawText(columns(0).now, right, tr("now"));
    painter.drawText(columns(0).wished, right, tr("target"));
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const ShownDriveNumber& each = numbers_[i];
        const Columns at = columns(static_cast<int>(i) + 1);
        painter.setFont(noteFont());
        painter.setPen(textColour(Tone::Quiet));
        painter.drawText(at.name, left, titleOf(each));
        paintBar(painter, each, at.bar);
        painter.setFont(font());
        painter.setPen(live_ ? palette().color(QPalette::WindowText) : textColour(Tone::NotLive));
        painter.drawText(at.now, right, numberOrLast(each, each.number.now, live_));
        painter.setPen(textColour(told_ ? Tone::Demand : Tone::NotLive));
        painter.drawText(at.wished, right, numberOrLast(each, each.number.wished, told_));
    }
}

void AxisNumbers::paintBar(QPainter& painter, const ShownDriveNumber& number,
                           const QRect& box) const {
    const DriveNumber& n = number.number;
    if (box.width() == 0 || !n.min || !n.max || !(*n.max > *n.min)) return;
    const double high = units(2);
    const QRectF track{box.left() * 1.0, box.center().y() - high / 2, box.width() * 1.0, high};
    painter.setPen(Qt::NoPen);
    painter.setBrush(markColour(Tone::Track));
    painter.drawRoundedRect(track, units(0.5), units(0.5));
    const auto place = [&](double value) {
        const double share = std::clamp((value - *n.min) / (*n.max - *n.min), 0.0, 1.0);
        return track.left() + share * (track.width() - units(0.75));
    };
    if (n.now && std::isfinite(*n.now)) {
        const QRectF needle{place(*n.now), track.top() - units(0.5), units(0.75) * 1.0,
                            high + 2 * units(0.5)};
        painter.setPen(live_ ? QPen{Qt::NoPen} : QPen{markColour(Tone::NotLive), 1});
        painter.setBrush(live_ ? QBrush{palette().color(QPalette::WindowText)} : QBrush{});
        painter.drawRect(needle);
    }
    if (!n.wished || !told_ || !std::isfinite(*n.wished)) return;
    const double x = place(*n.wished) + units(0.4), size = units(1.25);
    painter.setPen(Qt::NoPen);
    painter.setBrush(markColour(Tone::Demand));
    painter.drawPolygon(QPolygonF{{{x, track.top()},
                                   {x - size * 0.7, track.top() - size},
                                   {x + size * 0.7, track.top() - size}}});
}

}  // namespace cortex::explorer
