// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/system_graph.hpp"

#include <QGraphicsView>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace cortex::gui {

class GraphEdgeItem;
class GraphNodeItem;

// The drawing of a graph. The wheel zooms, a drag moves it, arrows go from node to node, Enter
// opens, F shows all of it.
class GraphCanvas : public QGraphicsView {
    Q_OBJECT
public:
    explicit GraphCanvas(QWidget* parent = nullptr);

    void refresh(const std::shared_ptr<const Frame>& frame);
    void select(std::uint32_t node);
    void foldAll();
    void fit(double least = 0);  // all of it, zoomed out to `least` at most
    const SystemGraph& graph() const { return graph_; }
    int crossings() const { return crossings_; }

Q_SIGNALS:
    void opened(const std::string& path);
    void changed();  // other nodes, or another one is selected

protected:
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void build();
    void mark();  // states and qualities as they are now
    void openNode(std::uint32_t node);
    void step(int layers, int rows);
    std::uint32_t nodeAt(const QPoint& point) const;

    std::shared_ptr<const Frame> frame_;
    std::uint64_t structures_ = 0;
    std::set<std::string> open_;
    SystemGraph graph_;
    int crossings_ = 0;
    QGraphicsScene scene_;
    std::vector<GraphNodeItem*> nodes_;
    std::vector<GraphEdgeItem*> lines_;
    std::string selected_;  // the key of a node
    bool fitted_ = true;    // all of it is shown, until the user zooms
};

}  // namespace cortex::gui
