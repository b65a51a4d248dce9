// SPDX-License-Identifier: Apache-2.0
#include "views/graph_items.hpp"

#include "style/look.hpp"
#include "widgets/rows.hpp"

#include <QPainter>
#include <algorithm>
#include <array>

namespace cortex::gui {

namespace {

// The last part of the path; the number of members stands beside that of a family.
QString lastName(const GraphNode& node) {
    const QString path = QString::fromStdString(node.key);
    const int part = node.family() ? -2 : -1;
    return path.section(QLatin1Char{'/'}, part, part);
}

// Text has one size however far the drawing is zoomed, so it is drawn in pixels of the screen.
QRectF inPixels(QPainter& painter, const QRectF& box) {
    const QRectF mapped = painter.worldTransform().mapRect(box);
    painter.setWorldTransform({});
    return mapped;
}

// The names of rules on a ground of their own, so that no line crosses them.
void paintRules(QPainter& painter, QPointF at, const QString& rules) {
    const QRectF middle = inPixels(painter, {at, QSizeF{}});
    painter.setFont(Look::font(TextSize::Note));
    const QFontMetricsF metrics{painter.font()};
    const double wide = metrics.horizontalAdvance(rules) + Look::length(2);
    const double high = metrics.height() + Look::length(0.5);
    const QRectF box{middle.x() - wide / 2, middle.y() - high / 2, wide, high};
    painter.setPen(Qt::NoPen);
    painter.setBrush(Look::colours().canvas);
    painter.drawRect(box);
    painter.setPen(Look::colours().ink);
    painter.drawText(box, Qt::AlignCenter, rules);
}

}  // namespace

QSizeF graphNodeSize() { return {Look::length(42), Look::length(11)}; }

GraphNodeItem::GraphNodeItem(std::uint32_t index, const GraphNode& node)
    : index_{index},
      name_{lastName(node)},
      type_{QString::fromStdString(node.type)},
      members_{static_cast<int>(node.paths.size())} {
    setToolTip(QString::fromStdString(node.key));
    setZValue(1);
}

void GraphNodeItem::choose(bool chosen) {
    chosen_ = chosen;
    update();
}

void GraphNodeItem::mark(Shape shape, std::optional<Shape> trouble) {
    if (shape == shape_ && trouble == trouble_) return;
    shape_ = shape;
    trouble_ = trouble;
    update();
}

QRectF GraphNodeItem::boundingRect() const {
    return QRectF{{}, graphNodeSize()}.adjusted(-Look::length(1.5), -Look::length(1.5),
                                                Look::length(1.5), Look::length(1.5));
}

void GraphNodeItem::paint(QPainter* painter, const QStyleOptionGraphicsItem* /*option*/,
                          QWidget* /*widget*/) {
    const Tokens& colours = Look::colours();
    const QRectF box = inPixels(*painter, {{}, graphNodeSize()});
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setBrush(colours.raised);
    painter->setPen({chosen_ ? colours.accent : colours.border,
                     chosen_ ? Look::length(0.75) : static_cast<double>(Look::lineWidth())});
    const double radius = std::min(Look::length(1), box.height() / 4);
    const double step = std::min(Look::length(0.75), box.height() / 6);
    if (members_ > 1) painter->drawRoundedRect(box.translated(step, -step), radius, radius);
    painter->drawRoundedRect(box, radius, radius);

    const double size = std::min(Look::length(3.5), box.height() * 0.8);
    const double gap = std::min(Look::length(2), size / 2);
    const auto mark = [&](double left, Shape shape) {
        cortex::gui::paint(*painter, {left, box.center().y() - size / 2, size, size}, shape,
                           colours);
    };
    double left = box.left() + gap, right = box.right() - gap;
    mark(left, shape_);
    left += size + gap;
    if (trouble_) {
        right -= size;
        mark(right, *trouble_);
        right -= gap;
    }
    const int line = QFontMetrics{Look::font(TextSize::Text, true)}.height();
    if (box.height() < line * 0.8) return;
    if (members_ > 1) {
        const QString badge = QStringLiteral("%1×").arg(members_);
        const int wide = textWidth(badge, true);
        right -= wide;
        paintText(*painter, QRectF{right, box.top(), wide + 1.0, box.height()}.toAlignedRect(),
                  badge, colours.ink, Qt::AlignRight, true);
        right -= gap;
    }
    const bool both = box.height() >= 2 * line;
    const double height = both ? box.height() / 2 : box.height();
    const QRectF row{left, box.top(), right - left, height};
    paintText(*painter, row.toRect(), name_, colours.ink, Qt::AlignLeft, true);
    if (both) paintText(*painter, row.translated(0, height - 1).toRect(), type_, colours.ink2);
}

GraphEdgeItem::GraphEdgeItem(const GraphEdge& edge, const QPainterPath& path, QPointF label)
    : path_{path}, label_{label}, delayed_{edge.delayed} {
    QStringList rules;
    for (const std::string& rule : edge.rules) rules << QString::fromStdString(rule);
    rules_ = rules.join(QStringLiteral(", "));
}

void GraphEdgeItem::choose(bool chosen) {
    chosen_ = chosen;
    setZValue(chosen ? 2 : 0);
    update();
}

void GraphEdgeItem::lose(bool lost) {
    if (lost != lost_) update();
    lost_ = lost;
}

QRectF GraphEdgeItem::boundingRect() const {
    return path_.boundingRect().adjusted(-Look::length(20), -Look::length(5), Look::length(20),
                                         Look::length(5));
}

void GraphEdgeItem::paint(QPainter* painter, const QStyleOptionGraphicsItem* /*option*/,
                          QWidget* /*widget*/) {
    const Tokens& colours = Look::colours();
    const QColor colour = chosen_ ? colours.accent : lost_ ? colours.data : colours.ink2;
    painter->setRenderHint(QPainter::Antialiasing);
    QPen pen{colour, Look::length(chosen_ ? 0.625 : 0.375)};
    pen.setCosmetic(true);
    if (delayed_ || lost_) pen.setDashPattern({4, 3});
    painter->setPen(pen);
    painter->setBrush(Qt::NoBrush);
    painter->drawPath(path_);
    const QTransform scene = painter->worldTransform();
    const QPointF end = path_.currentPosition();
    const double tip = Look::length(2);
    const QRectF box = inPixels(*painter, {end, QSizeF{}});
    const std::array arrow{box.topLeft(), box.topLeft() + QPointF{-tip, -tip / 2},
                           box.topLeft() + QPointF{-tip, tip / 2}};
    painter->setPen(Qt::NoPen);
    painter->setBrush(colour);
    painter->drawPolygon(arrow.data(), static_cast<int>(arrow.size()));
    painter->setWorldTransform(scene);
    if (chosen_) paintRules(*painter, label_, rules_);
}

}  // namespace cortex::gui
