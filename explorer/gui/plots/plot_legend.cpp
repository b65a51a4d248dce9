// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_legend.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "plots/lanes.hpp"
#include "plots/statistics.hpp"
#include "plots/tag_strip.hpp"
#include "plots/time_ticks.hpp"
#include "style/look.hpp"
#include "widgets/rows.hpp"

#include <QContextMenuEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace cortex::gui {

namespace {

int lineHeight() { return Look::units(4.5); }
int entryHeight() { return 3 * lineHeight() + Look::units(2); }
int headHeight() { return Look::units(7); }
int sideOf() { return Look::units(2); }
// Three numbers beside each other, of which the longest with one digit is whole in any font.
int legendWidth() {
    const int longest = textWidth(QStringLiteral("−5×10⁻³⁰⁰")) + sideOf() / 2 + 1;
    return std::max(Look::units(57), 3 * longest + 2 * sideOf());
}
int thirdOf(int width) { return (width - 2 * sideOf()) / 3; }
int valueWidth(int width) { return thirdOf(width) - sideOf() / 2; }

}  // namespace

PlotLegend::PlotLegend(QWidget* parent) : QWidget{parent} {
    setAccessibleName(tr("Lines"));
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Minimum);
}

QSize PlotLegend::sizeHint() const {
    const int facts = statistics_ ? static_cast<int>(facts_.size()) + 2 : 0;
    return {legendWidth(),
            headHeight() + static_cast<int>(rows_.size()) * entryHeight() + facts * lineHeight()};
}

PlotLegend::Row PlotLegend::rowOf(const DrawnLine& line, const Recorder& recorder, TimeSpan span,
                                  const Cursors& cursors, std::optional<double> at) const {
    Row row{
        line.line.tag, line.line.pen(2), plainText(line.line.item.path), line.line.itemName(), {}};
    row.wide = !line.line.known || (line.line.lane && !cursors.shown);
    if (!line.line.known) {
        row.values[0] = tr("not heard of");
        return row;
    }
    const auto text = [&](double value) {
        if (std::isnan(value)) return QStringLiteral("—");
        return line.line.lane ? wordOf(line.line, recorder, value)
                              : fittingNumber(line.line.data, value, [](const QString& shown) {
                                    return textWidth(shown) <= valueWidth(legendWidth());
                                });
    };
    if (!line.line.unit().isEmpty()) row.item += QStringLiteral(" (%1)").arg(line.line.unit());
    if (line.line.demand) row.item += tr(", demanded");
    if (cursors.shown) {
        const double a = line.valueAt(cursors.a), b = line.valueAt(cursors.b);
        row.values = {text(a), text(b), line.line.lane ? QString{} : text(b - a)};
        return row;
    }
    const bool silent = line.silentUntil > 0 && !at;
    row.values[0] = silent ? QStringLiteral("—") : text(at ? line.valueAt(*at) : line.newest());
    if (!line.line.lane) {
        const auto [first, last] = line.inside(span);
        const Extent extent = line.any() ? line.extent(first, last) : Extent{};
        row.values[1] = extent.any() ? text(extent.min) : QStringLiteral("—");
        row.values[2] = extent.any() ? text(extent.max) : QStringLiteral("—");
    }
    return row;
}

void PlotLegend::show(const std::vector<DrawnLine>& lines, const Recorder& recorder, TimeSpan span,
                      const Cursors& cursors, bool follows) {
    const auto before = rows_;
    std::optional<double> at = cursors.pointer;
    if (!at && !follows) at = span.to;
    rows_.clear();
    for (const DrawnLine& each : lines) {
        rows_.push_back(rowOf(each, recorder, span, cursors, at));
    }
    const QString first = cursors.pointer ? tr("pointer") : at ? tr("at end") : tr("newest");
    heads_ = cursors.shown ? std::array{cursorName('A', cursors.a, span),
                                        cursorName('B', cursors.b, span), QStringLiteral("B − A")}
                           : std::array{first, tr("min"), tr("max")};
    if (statistics_) fillFacts(lines, span, cursors);
    if (before.size() != rows_.size()) updateGeometry();
    describe();
    update();
}

void PlotLegend::fillFacts(const std::vector<DrawnLine>& lines, TimeSpan span,
                           const Cursors& cursors) {
    const std::size_t before = facts_.size();
    facts_.clear();
    title_.clear();
    for (const DrawnLine& each : lines) {
        if (each.line.tag != chosen_ || each.line.lane || !each.any()) continue;
        const TimeSpan of = cursors.shown ? cursors.span() : span;
        const Statistics found = statisticsOf(each, of);
        title_ = cursors.shown ? tr("%1, %2 to %3: %4")
                                     .arg(chosen_)
                                     .arg(heads_[0], heads_[1], durationText(of.length()))
                               : tr("%1, visible: %2").arg(chosen_).arg(durationText(of.length()));
        const auto number = [&](double value, const QString& after = {}) {
            const QString unit = QStringLiteral(" %1%2").arg(each.line.unit(), after);
            const int room = legendWidth() - 2 * sideOf() - namesWidth() - textWidth(unit);
            return fittingNumber(
                       each.line.data, value,
                       [room](const QString& shown) { return textWidth(shown) <= room; }) +
                   unit;
        };
        facts_.push_back({tr("samples"), QString::number(found.count)});
        facts_.push_back({tr("missing"), QString::number(found.missing)});
        if (found.count == 0) break;
        facts_.push_back({tr("duration"), durationText(found.length)});
        facts_.push_back({tr("min"), number(found.min)});
        facts_.push_back({tr("mean"), number(found.mean)});
        facts_.push_back({tr("max"), number(found.max)});
        facts_.push_back({QStringLiteral("σ"), number(found.deviation)});
        facts_.push_back({tr("slope"), number(found.slope, tr(" per s"))});
    }
    if (before != facts_.size()) updateGeometry();
}

int PlotLegend::namesWidth() const {
    int width = 0;
    for (const auto& [name, value] : facts_) width = std::max(width, textWidth(name));
    return width + sideOf();
}

void PlotLegend::showStatistics(bool wanted) {
    statistics_ = wanted;
    facts_.clear();
    updateGeometry();
}

void PlotLegend::choose(int tag) {
    if (tag == chosen_) return;
    chosen_ = tag;
    Q_EMIT chosenChanged(tag);
    update();
}

QStringList PlotLegend::texts() const {
    QStringList texts;
    for (const Row& each : rows_) {
        QStringList parts{QString::number(each.tag), each.path, each.item};
        for (std::size_t i = 0; i < heads_.size(); ++i) {
            if (!each.values[i].isEmpty()) parts.append(heads_[i] + ' ' + each.values[i]);
        }
        texts.append(parts.join(' '));
    }
    if (statistics_ && !facts_.empty()) texts.append(title_);
    for (const auto& [name, value] : facts_) texts.append(name + ' ' + value);
    return texts;
}

void PlotLegend::describe() {
    const QString text = texts().join(QStringLiteral("; "));
    if (text != accessibleDescription()) setAccessibleDescription(text);
}

int PlotLegend::tagAt(int y) const {
    const int row = (y - headHeight()) / entryHeight();
    const bool hit = y >= headHeight() && row < static_cast<int>(rows_.size());
    return hit ? rows_[static_cast<std::size_t>(row)].tag : 0;
}

void PlotLegend::mousePressEvent(QMouseEvent* event) {
    if (const int tag = tagAt(event->pos().y())) choose(tag);
    event->ignore();  // the plot has the keyboard
}

void PlotLegend::contextMenuEvent(QContextMenuEvent* event) {
    Q_EMIT menuWanted(tagAt(event->pos().y()), event->globalPos());
}

void PlotLegend::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    const Tokens& c = Look::colours();
    const int side = sideOf(), third = thirdOf(width()), line = lineHeight();
    const auto thirds = [&](int y, const std::array<QString, 3>& texts, const QColor& colour) {
        for (int i = 0; i < 3; ++i) {
            paintText(painter, {side + i * third, y, valueWidth(width()), line},
                      texts[static_cast<std::size_t>(i)], colour, Qt::AlignRight);
        }
    };
    thirds(side / 2, heads_, c.ink2);
    int y = headHeight();
    for (const Row& each : rows_) {
        if (each.tag == chosen_ && rows_.size() > 1) {
            painter.fillRect(QRect{0, y, Look::units(0.75), 3 * line}, c.accent);
        }
        paintTag(painter, {side, y, tagSize(), tagSize()}, each.tag, each.pen.color());
        painter.setPen(each.pen);
        const int left = side + tagSize() + side / 2, after = left + Look::units(6);
        painter.drawLine(left, y + line / 2, after - side / 2, y + line / 2);
        const QFontMetrics metrics{Look::font(TextSize::Text, true)};
        paintText(painter, {after, y, width() - after - side, line},
                  metrics.elidedText(each.path, Qt::ElideLeft, width() - after - side), c.ink,
                  Qt::AlignLeft, true);
        paintText(painter, {after, y + line, width() - after - side, line}, each.item, c.ink2);
        if (each.wide) {
            paintText(painter, {after, y + 2 * line, width() - after - side, line}, each.values[0],
                      c.ink);
        } else {
            thirds(y + 2 * line, each.values, c.ink);
        }
        y += entryHeight();
    }
    if (statistics_ && !facts_.empty()) paintFacts(painter, y);
}

void PlotLegend::paintFacts(QPainter& painter, int y) const {
    const Tokens& c = Look::colours();
    const int side = sideOf(), line = lineHeight();
    paintText(painter, {side, y, width() - 2 * side, line}, title_, c.ink2);
    const int names = namesWidth();
    for (const auto& [name, value] : facts_) {
        y += line;
        paintText(painter, {side, y, names, line}, name, c.ink2);
        paintText(painter, {side + names, y, width() - 2 * side - names, line}, value, c.ink,
                  Qt::AlignRight);
    }
}

}  // namespace cortex::gui
