// SPDX-License-Identifier: Apache-2.0
#include "views/graph_canvas.hpp"

#include "model/layered_layout.hpp"
#include "style/look.hpp"
#include "views/graph_items.hpp"

#include <QKeyEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace cortex::gui {

namespace {

constexpr double leastZoom = 0.05, mostZoom = 2;
constexpr double leastFit = 0.6;  // where names can still be read

double columnWidth() { return Look::length(54); }
double lineHeight() { return Look::length(15); }

struct NodeMarks {
    Shape shape = Shape::Unknown;
    std::optional<Shape> trouble;
};

// The worst of a family stands for it.
NodeMarks marksOf(const Frame& frame, const GraphNode& node) {
    NodeMarks marks;
    for (const std::string& path : node.paths) {
        const auto place = frame.find(path);
        if (!place) {
            const GoneAgent* gone = frame.goneFrom(path);
            marks.trouble = gone != nullptr && gone->ended ? Shape::Ended : Shape::Lost;
            continue;
        }
        const AgentFrame& agent = frame.agents[place->agent];
        const auto state = agent.state(place->simplex);
        const Quality quality = agent.lost() ? Quality::Lost : agent.quality(place->simplex);
        const bool known = agent.lost() || agent.came(place->simplex);
        const Excuse excuse = frame.excuse(*place);
        if (known && quality != Quality::Good && excuse != Excuse::Rests) {
            marks.trouble = excuse == Excuse::Ended ? Shape::Ended : shapeOf(quality);
        }
        if (marks.shape == Shape::Fault) continue;
        if (state)
            marks.shape = shapeOf(*state);
        else if (!frame.type(*place).active())
            marks.shape = Shape::Data;
    }
    return marks;
}

}  // namespace

GraphCanvas::GraphCanvas(QWidget* parent) : QGraphicsView{parent} {
    setScene(&scene_);
    setFrameShape(QFrame::NoFrame);
    setDragMode(QGraphicsView::ScrollHandDrag);
    setTransformationAnchor(QGraphicsView::AnchorUnderMouse);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("System graph"));
}

void GraphCanvas::refresh(const std::shared_ptr<const Frame>& frame) {
    frame_ = frame;
    if (frame->structures != structures_) build();
    mark();
}

void GraphCanvas::build() {
    structures_ = frame_->structures;
    graph_ = makeSystemGraph(*frame_, open_);
    std::vector<LayoutEdge> edges;
    for (const GraphEdge& edge : graph_.edges) edges.push_back({edge.from, edge.to, edge.delayed});
    const LayeredLayout layout = layered(graph_.nodes.size(), edges);
    crossings_ = layout.crossings;

    scene_.clear();
    nodes_.clear();
    lines_.clear();
    scene_.setBackgroundBrush(Look::colours().canvas);
    const auto place = [](const LayoutPoint& point) {
        return QPointF{point.layer * columnWidth(), point.row * lineHeight()};
    };
    for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i) {
        nodes_.push_back(new GraphNodeItem{i, graph_.nodes[i]});
        nodes_.back()->setPos(place(layout.nodes[i]));
        scene_.addItem(nodes_.back());
    }
    const double middle = graphNodeSize().height() / 2, wide = graphNodeSize().width();
    QRectF paths;
    std::map<double, int> lanes;  // of what goes back, below each component
    for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
        const GraphEdge& edge = graph_.edges[i];
        const QPointF from = place(layout.nodes[edge.from]) + QPointF{wide, middle};
        const QPointF to = place(layout.nodes[edge.to]) + QPointF{0, middle};
        QPainterPath path{from};
        QPointF label = (from + to) / 2;
        if (layout.back[i]) {
            const double below = layout.bottom[i] * lineHeight() + graphNodeSize().height() +
                                 Look::length(3) +
                                 Look::length(1.5) * (lanes[layout.bottom[i]]++ % 8);
            const double out = Look::length(5);
            path.cubicTo(from + QPointF{out, 0}, {from.x() + out, below}, {from.x(), below});
            path.lineTo(to.x(), below);
            path.cubicTo({to.x() - out, below}, to - QPointF{out, 0}, to);
            label = {(from.x() + to.x()) / 2, below};
        } else {
            const auto reach = [&](QPointF next) {
                const double half = (next.x() - path.currentPosition().x()) / 2;
                path.cubicTo(path.currentPosition() + QPointF{half, 0}, next - QPointF{half, 0},
                             next);
            };
            for (const LayoutPoint& bend : layout.bends[i]) {
                reach(place(bend) + QPointF{0, middle});
                path.lineTo(place(bend) + QPointF{wide, middle});
            }
            reach(to);
            label = path.pointAtPercent(0.5);
        }
        paths |= path.boundingRect();
        lines_.push_back(new GraphEdgeItem{edge, path, label});
        scene_.addItem(lines_.back());
    }
    QRectF all;
    for (const GraphNodeItem* each : nodes_) all |= each->sceneBoundingRect();
    all |= paths;
    const double margin = Look::length(6);
    scene_.setSceneRect(all.adjusted(-margin, -margin, margin, margin));
    const auto chosen = std::ranges::find(graph_.nodes, selected_, &GraphNode::key);
    select(chosen == graph_.nodes.end()
               ? noSimplex
               : static_cast<std::uint32_t>(chosen - graph_.nodes.begin()));
    if (fitted_) fit(leastFit);
}

void GraphCanvas::mark() {
    std::vector<bool> lost(graph_.nodes.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const NodeMarks marks = marksOf(*frame_, graph_.nodes[i]);
        lost[i] = marks.trouble == cortex::gui::Shape::Lost;
        nodes_[i]->mark(marks.shape, marks.trouble);
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        lines_[i]->lose(lost[graph_.edges[i].from] || lost[graph_.edges[i].to]);
    }
}

void GraphCanvas::select(std::uint32_t node) {
    if (node != noSimplex) selected_ = graph_.nodes[node].key;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) nodes_[i]->choose(i == node);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        lines_[i]->choose(node != noSimplex &&
                          (graph_.edges[i].from == node || graph_.edges[i].to == node));
    }
    if (node != noSimplex) {
        nodes_[node]->ensureVisible();
        setAccessibleDescription(
            QString::fromStdString(graph_.nodes[node].key + " " + graph_.nodes[node].type));
    }
    Q_EMIT changed();
}

void GraphCanvas::foldAll() {
    open_.clear();
    if (frame_) build(), mark();
}

void GraphCanvas::fit(double least) {
    fitted_ = true;
    if (graph_.nodes.empty()) return;
    fitInView(sceneRect(), Qt::KeepAspectRatio);
    const double zoom = transform().m11();
    const double best = std::clamp(zoom, least, 1.0);  // a small graph is not blown up
    scale(best / zoom, best / zoom);
    if (zoom < least) centerOn(sceneRect().left(), sceneRect().center().y());
}

void GraphCanvas::openNode(std::uint32_t node) {
    const GraphNode& shown = graph_.nodes[node];
    if (!shown.family()) {
        Q_EMIT opened(shown.paths.front());
        return;
    }
    open_.insert(shown.key);
    selected_ = shown.paths.front();
    build();
    mark();
}

std::uint32_t GraphCanvas::nodeAt(const QPoint& point) const {
    for (QGraphicsItem* item : items(point)) {
        const auto found = std::ranges::find(
            nodes_, item, [](GraphNodeItem* node) -> QGraphicsItem* { return node; });
        if (found != nodes_.end()) return (*found)->index();
    }
    return noSimplex;
}

// The nearest node in that direction.
void GraphCanvas::step(int layers, int rows) {
    const auto at = std::ranges::find(graph_.nodes, selected_, &GraphNode::key);
    if (at == graph_.nodes.end()) {
        if (!nodes_.empty()) select(0);
        return;
    }
    const auto here = nodes_[static_cast<std::size_t>(at - graph_.nodes.begin())]->pos();
    std::uint32_t best = noSimplex;
    double least = 0;
    for (const GraphNodeItem* node : nodes_) {
        const QPointF way = node->pos() - here;
        const double along = layers * way.x() + rows * way.y();
        const double aside = std::abs(rows * way.x()) + std::abs(layers * way.y());
        if (along <= 1 || (rows != 0 && aside > 1)) continue;
        const double far = along + 2 * aside;
        if (best != noSimplex && far >= least) continue;
        best = node->index();
        least = far;
    }
    if (best != noSimplex) select(best);
}

void GraphCanvas::wheelEvent(QWheelEvent* event) {
    const double factor = std::pow(1.0015, event->angleDelta().y());
    const double zoom = transform().m11() * factor;
    if (zoom < leastZoom || zoom > mostZoom) return;
    fitted_ = false;
    scale(factor, factor);
}

void GraphCanvas::keyPressEvent(QKeyEvent* event) {
    const auto at = std::ranges::find(graph_.nodes, selected_, &GraphNode::key);
    switch (event->key()) {
        case Qt::Key_Left:
            return step(-1, 0);
        case Qt::Key_Right:
            return step(1, 0);
        case Qt::Key_Up:
            return step(0, -1);
        case Qt::Key_Down:
            return step(0, 1);
        case Qt::Key_F:
            return fit();
        case Qt::Key_Plus:
            fitted_ = false;
            return scale(1.25, 1.25);
        case Qt::Key_Minus:
            fitted_ = false;
            return scale(0.8, 0.8);
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (at != graph_.nodes.end()) {
                openNode(static_cast<std::uint32_t>(at - graph_.nodes.begin()));
            }
            return;
        default:
            QGraphicsView::keyPressEvent(event);
    }
}

void GraphCanvas::mousePressEvent(QMouseEvent* event) {
    const std::uint32_t node = nodeAt(event->pos());
    if (node != noSimplex) select(node);
    QGraphicsView::mousePressEvent(event);
}

void GraphCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
    const std::uint32_t node = nodeAt(event->pos());
    if (node != noSimplex) openNode(node);
}

void GraphCanvas::resizeEvent(QResizeEvent* event) {
    QGraphicsView::resizeEvent(event);
    if (fitted_) fit(leastFit);
}

// Another theme or size of text.
void GraphCanvas::changeEvent(QEvent* event) {
    QGraphicsView::changeEvent(event);
    const bool look = event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange;
    if (look && frame_) build(), mark();
}

}  // namespace cortex::gui
