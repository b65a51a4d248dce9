// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/system_graph.hpp"
#include "style/shapes.hpp"

#include <QGraphicsItem>
#include <QPainterPath>
#include <optional>

// What stands in the drawing of a graph.
namespace cortex::gui {

QSizeF graphNodeSize();

// A simplex or a family, with state, name, type and quality.
class GraphNodeItem : public QGraphicsItem {
public:
    GraphNodeItem(std::uint32_t index, const GraphNode& node);

    std::uint32_t index() const { return index_; }
    void choose(bool chosen);
    void mark(Shape shape, std::optional<Shape> trouble);

    QRectF boundingRect() const override;
    void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

private:
    std::uint32_t index_;
    QString name_, type_;
    int members_;
    bool chosen_ = false;
    Shape shape_ = Shape::Unknown;
    std::optional<Shape> trouble_;
};

// A relationship with its arrow at the reader; the names of its rules at `label` while it is
// chosen.
class GraphEdgeItem : public QGraphicsItem {
public:
    GraphEdgeItem(const GraphEdge& edge, const QPainterPath& path, QPointF label);

    void choose(bool chosen);
    void lose(bool lost);  // one of its ends is lost

    QRectF boundingRect() const override;
    void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

private:
    QPainterPath path_;
    QPointF label_;
    QString rules_;
    bool delayed_, chosen_ = false, lost_ = false;
};

}  // namespace cortex::gui
