// SPDX-License-Identifier: Apache-2.0
#include "cortex/explorer/small_plot.hpp"

#include "cortex/core/type_model.hpp"

#include "model/value_text.hpp"
#include "style/hatch.hpp"
#include "style/look.hpp"

#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>
#include <QVector>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

namespace cortex::explorer {

using gui::Look;
using gui::TextSize;
using gui::Tokens;

namespace {

constexpr double longestStep = 0.5;  // s between two moments; what is longer is a gap
constexpr double rounding = 1e-12, leastRange = 1e-13;  // of what is level but for rounding
constexpr double longSpan = 120;                        // s, told in minutes from here on
constexpr double margin = 0.05;                         // of the values, above and below

struct Moment {
    double seconds = 0;
    std::optional<double> value;
};

struct Line {
    QString name;
    std::size_t colour = 0;
    bool demand = false;
    std::deque<Moment> moments;
};

struct Stretch {
    double from = 0, to = 0;
};

QString numberText(double number) { return gui::numberText(DataItem{}, number); }

// With as many digits as tell a hundredth of the range.
QString axisText(double number, double range) {
    DataItem item;
    item.resolution = range > 0 ? std::pow(10.0, std::floor(std::log10(range)) - 1) : 0;
    return gui::numberText(item, number);
}

std::vector<Stretch> gapsOf(const Line& line, double now) {
    std::vector<Stretch> gaps;
    const auto add = [&](double from, double to) {
        if (!gaps.empty() && from <= gaps.back().to) {
            gaps.back().to = std::max(gaps.back().to, to);
        } else {
            gaps.push_back({from, to});
        }
    };
    for (std::size_t i = 1; i < line.moments.size(); ++i) {
        const Moment& one = line.moments[i - 1];
        const Moment& next = line.moments[i];
        const bool cut = !one.value || !next.value || next.seconds - one.seconds > longestStep;
        if (cut) add(one.seconds, next.seconds);
    }
    if (line.moments.empty()) return gaps;
    const Moment& last = line.moments.back();
    if (!last.value || now - last.seconds > longestStep) add(last.seconds, now);
    return gaps;
}

}  // namespace

struct SmallPlot::Content {
    QString title, unit;
    std::vector<Line> lines;
    std::optional<double> min, max;
    double span = 10, now = 0;

    struct Place {
        QRectF box;
        double low = 0, high = 1, from = 0, to = 1;
        double x(double seconds) const {
            return box.left() + (seconds - from) / (to - from) * box.width();
        }
        double y(double value) const {
            return box.bottom() - (value - low) / (high - low) * box.height();
        }
    };
    Place place(const QRect& all) const;
    void paintLimits(QPainter& painter, const Place& place) const;
    void paintLine(QPainter& painter, const Place& place, const Line& line) const;
    QString head(double width) const;
    void paintTexts(QPainter& painter, const Place& place, const QRect& all) const;
    void paintNames(QPainter& painter, const Place& place) const;
};

SmallPlot::Content::Place SmallPlot::Content::place(const QRect& all) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Line& line : lines) {
        for (const Moment& each : line.moments) {
            if (!each.value || !std::isfinite(*each.value)) continue;
            least = std::min(least, *each.value);
            most = std::max(most, *each.value);
        }
    }
    Place result;
    if (least <= most) {
        const double size = std::max(std::abs(least), std::abs(most));
        const bool level = most - least <= std::max(size * rounding, leastRange);
        const double around = level ? std::max(size * margin, 0.01) : (most - least) * margin;
        result.low = least - around;
        result.high = most + around;
    }
    result.from = now - span;
    result.to = now;
    const double line = QFontMetricsF{Look::font(TextSize::Note)}.height();
    const QFontMetricsF metrics{Look::font(TextSize::Note)};
    const double range = result.high - result.low;
    const double left = std::max(metrics.horizontalAdvance(axisText(result.low, range)),
                                 metrics.horizontalAdvance(axisText(result.high, range))) +
                        Look::length(2);
    result.box = QRectF{all}.adjusted(left, line + Look::length(0.5), -Look::length(1),
                                      -line - Look::length(0.5));
    return result;
}

void SmallPlot::Content::paintLimits(QPainter& painter, const Place& place) const {
    const Tokens& c = Look::colours();
    const auto edge = [&](double limit, bool upper) {
        const double y = place.y(limit);
        const double inside = std::clamp(y, place.box.top(), place.box.bottom());
        painter.fillRect(upper ? QRectF{place.box.topLeft(), QPointF{place.box.right(), inside}}
                               : QRectF{QPointF{place.box.left(), inside}, place.box.bottomRight()},
                         c.warnBg);
        if (y != inside) return;
        QPen pen{c.warnEdge, 1};
        pen.setDashPattern({6, 4});
        painter.setPen(pen);
        painter.drawLine(QPointF{place.box.left(), y}, QPointF{place.box.right(), y});
    };
    if (max) edge(*max, true);
    if (min) edge(*min, false);
}

void SmallPlot::Content::paintLine(QPainter& painter, const Place& place, const Line& line) const {
    QPen pen{Look::colours().series[line.colour % Look::colours().series.size()],
             Look::length(0.45)};
    if (line.demand) pen.setDashPattern({5, 3});
    pen.setJoinStyle(Qt::RoundJoin);
    pen.setCapStyle(Qt::FlatCap);
    painter.setPen(pen);
    QPolygonF points;
    double last = 0;
    const auto flush = [&] {
        if (points.size() > 1) painter.drawPolyline(points);
        points.clear();
    };
    for (const Moment& each : line.moments) {
        if (!each.value || (!points.isEmpty() && each.seconds - last > longestStep)) flush();
        if (!each.value || !std::isfinite(*each.value)) continue;
        points.append({place.x(each.seconds), place.y(*each.value)});
        last = each.seconds;
    }
    flush();
}

// Where there is little room the title is cut, but never its unit.
QString SmallPlot::Content::head(double width) const {
    const QFontMetricsF metrics{Look::font(TextSize::Note, true)};
    const QString behind = unit.isEmpty() ? QString{} : QStringLiteral(" (%1)").arg(unit);
    if (metrics.horizontalAdvance(title + behind) <= width) return title + behind;
    const double left = width - metrics.horizontalAdvance(behind);
    return metrics.elidedText(title, Qt::ElideRight, left) + behind;
}

void SmallPlot::Content::paintTexts(QPainter& painter, const Place& place, const QRect& all) const {
    const Tokens& c = Look::colours();
    painter.setFont(Look::font(TextSize::Note, true));
    painter.setPen(c.ink);
    const double line = QFontMetricsF{painter.font()}.height(), gap = Look::length(1);
    const double wide = place.box.right() - gap;
    painter.drawText(QRectF{gap, 0, wide, line}, Qt::AlignLeft | Qt::AlignVCenter, head(wide));
    painter.setFont(Look::font(TextSize::Note));
    painter.setPen(c.ink2);
    const double width = place.box.left() - gap;
    const double range = place.high - place.low;
    painter.drawText(QRectF{0, place.box.top(), width, line}, Qt::AlignRight | Qt::AlignTop,
                     axisText(place.high, range));
    painter.drawText(QRectF{0, place.box.bottom() - line, width, line},
                     Qt::AlignRight | Qt::AlignBottom, axisText(place.low, range));
    const QRectF foot{place.box.left(), all.bottom() - line, place.box.width(), line};
    const QString past = span < longSpan ? tr("−%1 s").arg(span, 0, 'g', 3)
                                         : tr("−%1 min").arg(span / 60, 0, 'g', 3);
    painter.drawText(foot, Qt::AlignLeft | Qt::AlignVCenter, past);
    painter.drawText(foot, Qt::AlignRight | Qt::AlignVCenter, tr("now"));
}

// At the right of the title: a stroke as the line has it, and its name, as far as there is room.
void SmallPlot::Content::paintNames(QPainter& painter, const Place& place) const {
    const QFontMetricsF metrics{painter.font()};
    const double line = metrics.height(), gap = Look::length(1), stroke = Look::length(4);
    double right = place.box.right();
    const double wideHead =
        QFontMetricsF{Look::font(TextSize::Note, true)}.horizontalAdvance(head(right - gap));
    const double free = wideHead + 3 * gap;
    for (auto each = lines.rbegin(); each != lines.rend(); ++each) {
        if (each->name.isEmpty()) continue;
        const double room = right - stroke - gap - free;
        if (room < metrics.horizontalAdvance(QChar{0x2026})) return;
        const QString name = metrics.elidedText(each->name, Qt::ElideRight, room);
        const double wide = std::min(metrics.horizontalAdvance(name) + 1, room);
        painter.setPen(Look::colours().ink2);
        painter.drawText(QRectF{right - wide, 0, wide, line}, Qt::AlignCenter, name);
        QPen pen{Look::colours().series[each->colour % Look::colours().series.size()], 2};
        if (each->demand) pen.setDashPattern({3, 2});
        painter.setPen(pen);
        const double x = right - wide - gap - stroke;
        painter.drawLine(QPointF{x, line / 2}, QPointF{x + stroke, line / 2});
        right = x - 2 * gap;
    }
}

SmallPlot::SmallPlot(const QString& title, const QString& unit, QWidget* parent)
    : QWidget{parent}, content_{std::make_unique<Content>()} {
    content_->title = title;
    content_->unit = unit;
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    describe();
}

SmallPlot::~SmallPlot() = default;

int SmallPlot::addLine(const QString& name, bool demand) {
    Line line;
    line.name = name;
    line.demand = demand;
    const bool follows = demand && !content_->lines.empty();
    std::size_t free = 0;
    for (const Line& each : content_->lines) free = std::max(free, each.colour + 1);
    line.colour = follows ? content_->lines.back().colour : free;
    content_->lines.push_back(std::move(line));
    describe();
    return static_cast<int>(content_->lines.size()) - 1;
}

void SmallPlot::setSpan(double seconds) { content_->span = std::max(seconds, 0.1); }

void SmallPlot::setLimits(std::optional<double> min, std::optional<double> max) {
    content_->min = min;
    content_->max = max;
}

void SmallPlot::put(int line, double seconds, std::optional<double> value) {
    if (line < 0 || line >= static_cast<int>(content_->lines.size())) return;
    auto& moments = content_->lines[static_cast<std::size_t>(line)].moments;
    if (!moments.empty() && seconds <= moments.back().seconds) return;
    if (value && std::isnan(*value)) value.reset();
    moments.push_back({seconds, value});
}

void SmallPlot::setNow(double seconds) {
    content_->now = seconds;
    for (Line& each : content_->lines) {
        // One moment is kept beyond the left edge, so that the line begins there.
        while (each.moments.size() > 1 && each.moments[1].seconds < seconds - content_->span) {
            each.moments.pop_front();
        }
    }
    describe();
    update();
}

double SmallPlot::clock() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

QSize SmallPlot::sizeHint() const { return {Look::units(100), Look::units(40)}; }

QSize SmallPlot::minimumSizeHint() const { return {Look::units(60), Look::units(25)}; }

void SmallPlot::describe() {
    QStringList texts;
    for (const Line& each : content_->lines) {
        const bool any = !each.moments.empty() && each.moments.back().value;
        texts.append(QStringLiteral("%1 %2 %3")
                         .arg(each.name,
                              any ? numberText(*each.moments.back().value) : tr("no data"),
                              any ? content_->unit : QString{})
                         .trimmed());
    }
    const QString name = tr("Plot of %1").arg(content_->title);
    if (accessibleName() != name) setAccessibleName(name);
    const QString text = texts.join(QStringLiteral(", "));
    if (accessibleDescription() != text) setAccessibleDescription(text);
}

void SmallPlot::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    const Tokens& c = Look::colours();
    const Content::Place place = content_->place(rect());
    if (place.box.width() < 1 || place.box.height() < 1) return;
    painter.fillRect(place.box, c.canvas);
    painter.save();
    painter.setClipRect(place.box);
    content_->paintLimits(painter, place);
    for (const Line& line : content_->lines) {
        for (const Stretch& gap : gapsOf(line, content_->now)) {
            const double from = std::max(place.x(gap.from), place.box.left());
            const double to = std::min(place.x(gap.to), place.box.right());
            if (to > from) {
                gui::paintHatch(painter, {from, place.box.top(), to - from, place.box.height()});
            }
        }
    }
    for (const Line& line : content_->lines) content_->paintLine(painter, place, line);
    painter.restore();
    painter.setPen(QPen{c.line, 1});
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(place.box);
    content_->paintTexts(painter, place, rect());
    content_->paintNames(painter, place);
}

}  // namespace cortex::explorer
